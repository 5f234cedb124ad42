//! A minimal host: creates a device, drops a sheet on a sphere, records every frame into its own encoder, prints the status, and
//! writes the sheet as OBJ.
//!
//! `cargo run --release -p toile --example sheet`

use glam::{DVec2, DVec3};
use std::error::Error;
use std::path::Path;
use toile::gpu::readback::read_vec4s;
use toile::model::{Model, StepSettings};
use toile::scene::{Fabric, Mesh, Settings, Shape, Sheet};
use toile::{Cloth, Colliders, files};

fn main() -> Result<(), Box<dyn Error>> {
    // The device is the host's: a renderer brings the one that it draws with.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;

    let settings = Settings::new(Fabric::preset("cotton").ok_or("cotton is a preset")?);
    let mut sheet = Sheet::new("sheet", [64, 64], DVec2::splat(1.0));
    sheet.corner = DVec3::new(-0.5, 0.4, 0.5);
    sheet.down = DVec3::NEG_Z;
    let sphere = Shape::sphere(DVec3::ZERO, 0.25);
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let colliders = Colliders::new(None, vec![sphere]);
    let mut cloth = Cloth::new(&device, &model, &step, colliders)?;

    for frame in 1..=120 {
        let mut encoder = device.create_command_encoder(&Default::default());
        cloth.record(&device, &mut encoder);
        // A renderer draws the buffers of `simulation.frame()` here, with the same encoder.
        queue.submit([encoder.finish()]);
        // The status is that of the newest frame that is done: a host that does not wait sees it a frame or two later.
        device.poll(wgpu::PollType::Poll)?;
        if let Some(status) = cloth.status()?
            && frame % 20 == 0
        {
            let elongation = 100.0 * status.elongation_max;
            println!(
                "frame {frame}: step {}, fastest {:.2} m/s, elongation {elongation:.1} %",
                status.step, status.speed_max
            );
        }
    }

    let read = |buffer: &wgpu::Buffer| -> Result<Vec<_>, toile::Error> {
        Ok(read_vec4s(&device, &queue, buffer)?.into_iter().map(|v| v.truncate()).collect())
    };
    let buffers = cloth.frame();
    let mesh =
        Mesh { positions: read(&buffers.positions)?, normals: read(&buffers.normals)?, triangles: model.triangles() };
    files::write_obj(Path::new("sheet.obj"), &mesh)?;
    println!("wrote sheet.obj");
    Ok(())
}
