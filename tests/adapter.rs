//! A missing adapter is a failure that says what to install, never a silent skip.

use toile::Cloth;
use toile_lab::INSTALL_HINT;
use toile_lab::fixtures::{scene, sheet_model};
use toile_model::StepSettings;
use toile_workspace::{Gpu, gpu};

#[test]
fn without_an_adapter_the_hint_says_what_to_install() {
    let fault = Gpu::open(wgpu::Backends::empty()).expect_err("no backend has no adapter");
    assert!(fault.contains(INSTALL_HINT), "{fault}");
    assert!(INSTALL_HINT.contains("apt-get install -y mesa-vulkan-drivers libvulkan1"));
}

#[test]
fn there_is_an_adapter() {
    assert!(!gpu().adapter.is_empty());
}

#[test]
fn a_device_with_less_than_webgpu_is_refused_with_what_it_lacks() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).expect(INSTALL_HINT);
    let descriptor =
        wgpu::DeviceDescriptor { required_limits: wgpu::Limits::downlevel_defaults(), ..Default::default() };
    let (device, _) = pollster::block_on(adapter.request_device(&descriptor)).expect("the adapter gives a device");
    let scene = scene("hang", &[("n", "8")]);
    let model = sheet_model(&scene);
    let settings = StepSettings::new(&scene.settings, &model);
    let error = Cloth::new(&device, &model, &settings, Default::default()).expect_err("it has too few buffers");
    insta::assert_snapshot!(error.to_string(), @"the device has maxStorageBuffersPerShaderStage 4 but the kernels are made for 8, the default of WebGPU; create it with at least that");
}
