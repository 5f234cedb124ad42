//! Every kernel is valid WGSL under the limits of WebGPU, and says of itself what the table says.

use std::collections::BTreeSet;
use toile_kernels::{BUFFERS, Domain, Interface, Resource, TABLE, WORKGROUP_SIZE, buffer_row};

#[test]
fn every_kernel_is_named_like_its_entry_point_and_fits_the_default_limits() {
    for row in TABLE {
        let interface = Interface::of(row.kernel);
        assert_eq!(interface.entry, row.kernel.name());
        let size = if row.domain == Domain::Workgroup { interface.workgroup_size[0] } else { WORKGROUP_SIZE };
        assert_eq!(interface.workgroup_size, [size, 1, 1], "{}", interface.entry);
        assert!(size <= 256, "{}", interface.entry);
        let storage = interface.bindings.iter().filter(|b| matches!(b.resource, Resource::Storage { .. })).count();
        assert!(storage <= 8, "{} binds {storage} storage buffers", interface.entry);
    }
}

#[test]
fn a_name_is_the_same_resource_in_every_kernel() {
    let mut known: std::collections::BTreeMap<String, (Resource, &str)> = Default::default();
    for row in TABLE {
        for binding in Interface::of(row.kernel).bindings {
            let resource = match binding.resource {
                Resource::Storage { stride, .. } => Resource::Storage { written: false, stride },
                other => other,
            };
            let (first, by) = known.entry(binding.name.clone()).or_insert((resource, row.kernel.name()));
            assert_eq!(*first, resource, "{} in {} and in {by}", binding.name, row.kernel.name());
        }
    }
}

#[test]
fn the_buffer_table_has_each_buffer_of_the_kernels_once_and_no_other() {
    let bindings = TABLE.iter().flat_map(|row| Interface::of(row.kernel).bindings);
    let buffers = bindings.filter(|b| matches!(b.resource, Resource::Storage { .. } | Resource::Uniform { .. }));
    let named: BTreeSet<String> = buffers.map(|binding| binding.name).collect();
    let rows: BTreeSet<String> = BUFFERS.iter().map(|row| row.name.to_owned()).collect();
    assert_eq!(rows, named);
    assert_eq!(rows.len(), BUFFERS.len());
}

/// Cloths share it.
#[test]
fn no_kernel_writes_a_constant_buffer() {
    let bindings = TABLE.iter().flat_map(|row| Interface::of(row.kernel).bindings);
    let written = bindings.filter(|binding| matches!(binding.resource, Resource::Storage { written: true, .. }));
    let rows: Vec<_> = written.map(|binding| buffer_row(&binding.name)).collect();
    assert!(rows.iter().any(|row| row.name == "positions"));
    let constant: Vec<_> = rows.iter().filter(|row| row.role.is_constant()).map(|row| row.name).collect();
    assert!(constant.is_empty(), "kernels write {constant:?}");
}

/// A dispatch gives one dynamic offset.
#[test]
fn a_kernel_has_at_most_one_buffer_with_entries() {
    for row in TABLE {
        let bindings = Interface::of(row.kernel).bindings;
        let count = bindings.iter().filter(|binding| binding.has_entries()).count();
        assert!(count <= 1, "{} has {count} buffers with entries", row.kernel.name());
    }
}

/// A buffer that a kernel may write makes the device wait between its dispatches; one that it does not use takes a place.
#[test]
fn a_kernel_uses_what_it_binds_and_writes_what_it_may_write() {
    use naga::valid::{Capabilities, GlobalUse, ValidationFlags, Validator};
    for row in TABLE {
        let name = row.kernel.name();
        let module = naga::front::wgsl::parse_str(&row.kernel.source()).expect("it is WGSL");
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).expect("it is valid");
        for (handle, global) in module.global_variables.iter().filter(|(_, global)| global.binding.is_some()) {
            let used = info.get_entry_point(0)[handle];
            let global_name = global.name.as_deref().unwrap_or_default();
            assert!(!used.is_empty(), "{name} does not use {global_name}");
            if let naga::AddressSpace::Storage { access } = global.space {
                let writes = used.intersects(GlobalUse::WRITE | GlobalUse::ATOMIC);
                let may_write = access.contains(naga::StorageAccess::STORE);
                assert_eq!(writes, may_write, "{name} writes {global_name}, or says so");
            }
        }
    }
}
