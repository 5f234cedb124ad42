//! A page: a sheet falls on a ball, and a canvas shows it. It blocks nothing: what takes long is awaited.
//!
//! ```sh
//! cargo build --release -p toile --example web --target wasm32-unknown-unknown --no-default-features
//! wasm-bindgen --target web --out-dir target/web target/wasm32-unknown-unknown/release/examples/web.wasm
//! cp crates/toile/examples/web.html target/web/index.html && python3 -m http.server --directory target/web
//! ```

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    eprintln!("this example is a page for a browser: the head of crates/toile/examples/web.rs has the commands");
}

#[cfg(target_arch = "wasm32")]
fn main() {
    wasm_bindgen_futures::spawn_local(async {
        if let Err(error) = page::run().await {
            page::say(&format!("it ends: {error}"));
        }
    });
}

#[cfg(target_arch = "wasm32")]
mod page {
    use glam::{DVec2, DVec3, Vec3, Vec4};
    use std::error::Error;
    use toile::gpu::{Arrival, Kernels};
    use toile::scene::{Body, Cloth, Fabric, Mesh, Scene, Settings, Sheet};
    use toile::{Simulation, wgpu};
    use wasm_bindgen::{JsCast, JsValue};
    use wasm_bindgen_futures::JsFuture;
    use web_sys::{CanvasRenderingContext2d, Document, HtmlCanvasElement};

    /// Particles along each side of the sheet.
    const COUNT: usize = 32;
    /// Pixels of a metre.
    const SCALE: f64 = 400.0;
    /// Longest time that a frame goes on by [s]: a page in the background is not caught up with.
    const FRAME_MAX: f64 = 1.0 / 30.0;

    pub async fn run() -> Result<(), Box<dyn Error>> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::BROWSER_WEBGPU;
        let adapter = wgpu::Instance::new(descriptor).request_adapter(&Default::default()).await?;
        let (device, queue) = adapter.request_device(&Default::default()).await?;
        let kernels = Kernels::new(&device);
        let start = now();
        kernels.all_made().await?;
        let made = now() - start;
        let mut simulation = Simulation::new(&kernels, &scene())?;
        let canvas = canvas().ok_or("the page has no canvas")?;
        let mut under_way: Option<Arrival> = None;
        let mut before = now();
        loop {
            next_frame().await;
            let seconds = (now() - before).min(FRAME_MAX);
            before = now();
            let mut encoder = device.create_command_encoder(&Default::default());
            simulation.advance(&mut encoder, seconds)?;
            let worn = simulation.cloths().next().ok_or("the scene has a cloth")?;
            // A renderer draws the buffers of the frame here. A canvas needs their contents, which arrive later.
            if under_way.as_ref().is_none_or(Arrival::is_over) {
                under_way = Some(Arrival::of(&device, &mut encoder, &worn.cloth.frame().positions));
            }
            queue.submit([encoder.finish()]);
            // A device that is slower than the screen would fall behind for good.
            done(&queue).await;
            if let (Some(bytes), Some(status)) = (under_way.as_ref().and_then(Arrival::take), worn.cloth.status()?) {
                let positions: Vec<Vec4> = bytemuck::pod_collect_to_vec(&bytes);
                draw(&canvas, &positions);
                let stretched = 100.0 * status.elongation_max;
                let mean = positions.iter().map(|position| position.y).sum::<f32>() / positions.len() as f32;
                say(&format!(
                    "pipelines in {made:.1} s; step {}, stretched by {stretched:.1} % at most, {mean:.6} m high on average",
                    status.step
                ));
            }
        }
    }

    fn scene() -> Scene {
        let mut scene = Scene::new("page", Settings::new(Fabric::preset("cotton").expect("a preset")));
        let mut sheet = Sheet::new("sheet", [COUNT as u32; 2], DVec2::ONE);
        sheet.corner = DVec3::new(-0.5, 0.3, -0.5);
        scene.cloths = vec![Cloth::Sheet(sheet)];
        scene.bodies = vec![Body::Mesh(Mesh::sphere(Vec3::ZERO, 0.25, 32))];
        scene
    }

    /// Rows and columns of the sheet, seen from the front and a little above.
    fn draw(canvas: &CanvasRenderingContext2d, positions: &[Vec4]) {
        canvas.clear_rect(0.0, 0.0, 640.0, 480.0);
        canvas.begin_path();
        let line = |indices: &mut dyn Iterator<Item = usize>| {
            for (rank, index) in indices.enumerate() {
                let place = positions[index].truncate().as_dvec3();
                let [x, y] = [320.0 + SCALE * place.x, 220.0 - SCALE * (place.y - 0.4 * place.z)];
                if rank == 0 { canvas.move_to(x, y) } else { canvas.line_to(x, y) }
            }
        };
        for row in 0..COUNT {
            line(&mut (0..COUNT).map(|column| row * COUNT + column));
            line(&mut (0..COUNT).map(|column| column * COUNT + row));
        }
        canvas.stroke();
    }

    fn document() -> Document {
        web_sys::window().and_then(|window| window.document()).expect("a page has a window")
    }

    fn canvas() -> Option<CanvasRenderingContext2d> {
        let canvas = document().get_element_by_id("canvas")?.dyn_into::<HtmlCanvasElement>().ok()?;
        canvas.get_context("2d").ok()??.dyn_into().ok()
    }

    /// Shows a line under the canvas.
    pub fn say(text: &str) {
        if let Some(line) = document().get_element_by_id("line") {
            line.set_text_content(Some(text));
        }
    }

    /// Time since the page began [s].
    fn now() -> f64 {
        let performance = web_sys::window().and_then(|window| window.performance());
        1e-3 * performance.expect("a page has a clock").now()
    }

    async fn done(queue: &wgpu::Queue) {
        let promise = js_sys::Promise::new(&mut |resolve, _| {
            queue.on_submitted_work_done(move || drop(resolve.call0(&JsValue::NULL)));
        });
        JsFuture::from(promise).await.expect("nothing rejects it");
    }

    async fn next_frame() {
        let promise = js_sys::Promise::new(&mut |resolve, _| {
            let window = web_sys::window().expect("a page has a window");
            window.request_animation_frame(&resolve).expect("a page has frames");
        });
        JsFuture::from(promise).await.expect("nothing rejects it");
    }
}
