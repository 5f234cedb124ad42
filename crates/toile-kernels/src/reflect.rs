//! What a kernel's WGSL says of itself: bindings by global name, workgroup size, layouts of its structs.

use crate::{Kernel, buffer_row};
use naga::{AddressSpace, Expression, ImageClass, Literal, ScalarKind, StorageAccess, StorageFormat, TypeInner};

/// What a kernel's WGSL says of itself.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Interface {
    /// Name of the entry point.
    pub entry: String,
    /// Invocations of one workgroup, where a pipeline overrides nothing.
    pub workgroup_size: [u32; 3],
    /// Resources of group 0, by ascending binding number.
    pub bindings: Vec<Binding>,
    /// Layouts of the structs that its resources hold.
    pub structs: Vec<StructLayout>,
}

/// One resource of a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Binding {
    /// Name of the global variable: the same name is the same resource in every kernel.
    pub name: String,
    /// Binding number in group 0.
    pub number: u32,
    /// What it is.
    pub resource: Resource,
}

impl Binding {
    /// Whether it is a buffer with entries, of which a dispatch sees the one at its dynamic offset.
    pub fn has_entries(&self) -> bool {
        matches!(self.resource, Resource::Uniform { .. } | Resource::Storage { .. })
            && buffer_row(&self.name).role.has_entries()
    }
}

impl Resource {
    /// Bytes of an item of a buffer, 0 of a texture.
    pub fn stride(self) -> u32 {
        match self {
            Self::Uniform { size } => size,
            Self::Storage { stride, .. } => stride,
            _ => 0,
        }
    }
}

/// What a binding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resource {
    /// A uniform buffer of so many bytes.
    Uniform {
        /// Size of the struct [byte].
        size: u32,
    },
    /// A storage buffer.
    Storage {
        /// Whether the kernel writes it.
        written: bool,
        /// Bytes from one item to the next, or the whole size when it is not an array [byte].
        stride: u32,
    },
    /// A layered depth texture.
    DepthTexture,
    /// A layered texture of floats that are not filtered.
    FloatTexture,
    /// A texture of one layer: floats that are not filtered, or whole numbers.
    FlatTexture {
        /// Whether it has whole numbers.
        whole: bool,
    },
    /// A texture of one layer that the kernel writes.
    WrittenTexture {
        /// Whether it has two whole numbers a texel; otherwise it has four floats.
        whole: bool,
    },
}

/// Layout of a struct, as naga computes it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StructLayout {
    /// Name in the WGSL.
    pub name: String,
    /// Size [byte].
    pub span: u32,
    /// Fields in order.
    pub fields: Vec<StructField>,
}

/// A field of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StructField {
    /// Name in the WGSL.
    pub name: String,
    /// Offset from the start of the struct [byte].
    pub offset: u32,
}

impl Interface {
    /// Reads the interface of a kernel from its WGSL.
    ///
    /// # Panics
    /// When the WGSL is not valid: it is part of this crate, so that is a mistake in it, and the message shows where.
    pub fn of(kernel: Kernel) -> Self {
        let source = kernel.source();
        let module = parse(&source, kernel.name());
        let entry = match module.entry_points.as_slice() {
            [only] => only,
            other => panic!("{} has {} entry points; a file holds one kernel", kernel.name(), other.len()),
        };
        let mut bindings: Vec<Binding> = Vec::new();
        let mut structs = Vec::new();
        for (_, global) in module.global_variables.iter() {
            let Some(place) = &global.binding else { continue };
            let name = global.name.clone().unwrap_or_default();
            bindings.push(Binding { name, number: place.binding, resource: resource(&module, global) });
            collect_structs(&module, global.ty, &mut structs);
        }
        bindings.sort_by_key(|b| b.number);
        Self { entry: entry.name.clone(), workgroup_size: workgroup_size(&module, entry), bindings, structs }
    }

    /// The binding of a name.
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.bindings.iter().find(|b| b.name == name)
    }
}

/// Parses and validates WGSL under the limits of WebGPU.
fn parse(source: &str, name: &str) -> naga::Module {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)));
    module
}

fn workgroup_size(module: &naga::Module, entry: &naga::EntryPoint) -> [u32; 3] {
    let mut size = entry.workgroup_size;
    for (size, overridden) in size.iter_mut().zip(entry.workgroup_size_overrides.into_iter().flatten()) {
        let value = overridden.map(|expression| match module.global_expressions[expression] {
            Expression::Override(handle) => module.overrides[handle].init.map(|init| &module.global_expressions[init]),
            _ => None,
        });
        match value {
            None => {}
            Some(Some(Expression::Literal(Literal::U32(default)))) => *size = *default,
            Some(_) => panic!("the workgroup size of {} is an override without a plain default", entry.name),
        }
    }
    size
}

fn resource(module: &naga::Module, global: &naga::GlobalVariable) -> Resource {
    let inner = &module.types[global.ty].inner;
    match global.space {
        AddressSpace::Uniform => Resource::Uniform { size: inner.size(module.to_ctx()) },
        AddressSpace::Storage { access } => Resource::Storage {
            written: access.contains(StorageAccess::STORE),
            stride: match inner {
                TypeInner::Array { stride, .. } => *stride,
                other => other.size(module.to_ctx()),
            },
        },
        _ => match inner {
            TypeInner::Image { class: ImageClass::Depth { .. }, .. } => Resource::DepthTexture,
            TypeInner::Image { class: ImageClass::Storage { format, .. }, .. } => match format {
                StorageFormat::Rg32Uint => Resource::WrittenTexture { whole: true },
                StorageFormat::Rgba32Float => Resource::WrittenTexture { whole: false },
                other => panic!("kernels write no textures of the format {other:?}"),
            },
            TypeInner::Image { arrayed: false, class: ImageClass::Sampled { kind, .. }, .. } => {
                Resource::FlatTexture { whole: *kind == ScalarKind::Uint }
            }
            _ => Resource::FloatTexture,
        },
    }
}

fn collect_structs(module: &naga::Module, handle: naga::Handle<naga::Type>, found: &mut Vec<StructLayout>) {
    let ty = &module.types[handle];
    match &ty.inner {
        TypeInner::Array { base, .. } => collect_structs(module, *base, found),
        TypeInner::Struct { members, span } => {
            let fields = members
                .iter()
                .map(|m| StructField { name: m.name.clone().unwrap_or_default(), offset: m.offset })
                .collect();
            found.push(StructLayout { name: ty.name.clone().unwrap_or_default(), span: *span, fields });
        }
        _ => {}
    }
}
