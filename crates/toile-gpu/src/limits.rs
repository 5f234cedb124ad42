//! What the kernels expect of a device: the default limits of WebGPU.

use crate::GpuError;

/// An error when a device has less than the kernels are made for. wgpu checks some of it too late for an error, and some not at all.
pub(crate) fn check_limits(device: &wgpu::Device) -> Result<(), GpuError> {
    let named = |limits: &wgpu::Limits| {
        [
            ("maxStorageBuffersPerShaderStage", limits.max_storage_buffers_per_shader_stage),
            ("maxComputeWorkgroupStorageSize", limits.max_compute_workgroup_storage_size),
            ("maxComputeInvocationsPerWorkgroup", limits.max_compute_invocations_per_workgroup),
            ("maxComputeWorkgroupSizeX", limits.max_compute_workgroup_size_x),
            ("maxComputeWorkgroupsPerDimension", limits.max_compute_workgroups_per_dimension),
            ("maxColorAttachmentBytesPerSample", limits.max_color_attachment_bytes_per_sample),
        ]
    };
    for ((name, needed), (_, available)) in named(&wgpu::Limits::default()).into_iter().zip(named(&device.limits())) {
        if available < needed {
            return Err(GpuError::LimitTooLow { name, needed, available });
        }
    }
    Ok(())
}
