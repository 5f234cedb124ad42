//! A missing adapter is a failure that says what to install, never a silent skip.

use toile_workspace::{Gpu, INSTALL_HINT, gpu};

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
