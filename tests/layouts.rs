//! Struct layouts are proved, not promised: encase and naga agree on every shared struct, and a device reads what encase wrote.

use encase::{ShaderType, StorageBuffer, internal::CreateFrom, internal::ReadFrom, internal::WriteInto};
use std::collections::BTreeMap;
use std::fmt::{Debug, Write};
use toile_kernels::{Interface, Resource, StructLayout, TABLE, render_sides_source, structs};
use toile_workspace::{Compute, gpu};

/// Calls a macro with every struct that Rust and WGSL share.
macro_rules! for_every_struct {
    ($call:ident) => {
        $call!(
            StepParams,
            Span,
            LinkSpring,
            Limit,
            Node,
            Cluster,
            SmallTurn,
            Leader,
            Attachment,
            SeamPair,
            Hold,
            Midpoint,
            Probe,
            Contact,
            SideBox,
            Side,
            LayerBox,
            Drawn,
            Crossing,
            LayerCounts,
            Shape,
            Lag,
            Vertices,
            Gather,
            Displacement,
            Influence,
            Joint,
            Carry,
            PinTarget,
            Polish,
            PolishState,
            Status
        )
    };
}

/// Field names, offsets and size of a struct as encase lays it out.
macro_rules! encase_layouts {
    ($($name:ident),*) => {
        [$({
            let names = field_names(&structs::$name::default());
            let offset = |i| structs::$name::METADATA.offset(i) as u32;
            let fields = names.iter().enumerate().map(|(i, name)| (name.clone(), offset(i))).collect();
            Layout { name: stringify!($name), span: structs::$name::min_size().get() as u32, fields }
        }),*]
    };
}

struct Layout {
    name: &'static str,
    span: u32,
    fields: Vec<(String, u32)>,
}

/// Names of the fields of a flat struct, from its `Debug` text: "Span { first: 0, count: 0 }".
fn field_names(value: &impl Debug) -> Vec<String> {
    let text = format!("{value:?}");
    text.split_whitespace().filter_map(|word| word.strip_suffix(':')).map(str::to_owned).collect()
}

fn naga_layouts() -> BTreeMap<String, StructLayout> {
    let mut layouts = BTreeMap::new();
    for layout in TABLE.iter().flat_map(|row| Interface::of(row.kernel).structs) {
        let known: &mut StructLayout = layouts.entry(layout.name.clone()).or_insert_with(|| layout.clone());
        assert_eq!(*known, layout, "{} is one struct in all kernels", layout.name);
    }
    layouts
}

#[test]
fn encase_and_naga_lay_out_every_struct_alike() {
    let mut naga = naga_layouts();
    for Layout { name, span, fields } in for_every_struct!(encase_layouts) {
        let Some(layout) = naga.remove(name) else {
            // Only the render pass has it, which has no interface; the echo below proves it.
            assert_eq!(name, "Side", "a kernel uses {name}");
            continue;
        };
        let in_wgsl: Vec<_> = layout.fields.into_iter().map(|field| (field.name, field.offset)).collect();
        assert_eq!(fields, in_wgsl, "{name}: names and offsets");
        assert_eq!(span, layout.span, "{name}: size");
    }
    assert!(naga.is_empty(), "structs of the kernels that Rust does not have: {:?}", naga.keys());
}

/// The WGSL declaration of a struct, with plain instead of atomic words, and its fields with their types.
fn declaration(name: &str) -> (String, Vec<(String, String)>) {
    let sources = TABLE.iter().map(|row| row.kernel.source()).chain([render_sides_source()]);
    let opening = format!("struct {name} {{");
    let source = sources.into_iter().find(|source| source.contains(&opening)).expect("a kernel declares the struct");
    let start = source.find(&opening).expect("it does");
    let end = start + source[start..].find('}').expect("a struct ends") + 1;
    let text = source[start..end].replace("atomic<u32>", "u32");
    let fields = text.lines().filter_map(|line| {
        let (name, rest) = line.split("//").next()?.trim().trim_end_matches(',').split_once(": ")?;
        Some((name.to_owned(), rest.to_owned()))
    });
    let fields = fields.collect();
    (text, fields)
}

/// How WGSL names the words of a type.
fn parts_of(kind: &str) -> &'static [&'static str] {
    match kind {
        "vec3<f32>" => &[".x", ".y", ".z"],
        "vec4<f32>" => &[".x", ".y", ".z", ".w"],
        _ => &[""],
    }
}

/// A kernel that reads an array of the struct and writes the words of its fields, one after the other.
fn echo_source(name: &str) -> (String, Vec<(String, String)>) {
    let (declaration, fields) = declaration(name);
    let mut writes = String::new();
    let mut word = 0;
    for (field, kind) in &fields {
        for part in parts_of(kind) {
            writeln!(writes, "    words[id.x * WORDS + {word}u] = bitcast<u32>(items[id.x].{field}{part});")
                .expect("text");
            word += 1;
        }
    }
    let source = format!(
        "{declaration}\nconst WORDS: u32 = {word}u;\n\
         @group(0) @binding(0) var<storage, read> items: array<{name}>;\n\
         @group(0) @binding(1) var<storage, read_write> words: array<u32>;\n\
         @compute @workgroup_size(1) fn echo(@builtin(global_invocation_id) id: vec3<u32>) {{\n{writes}}}\n"
    );
    (source, fields)
}

/// The words that the device finds in the fields of some values of a struct, and those that Rust has there.
fn echo<T>(name: &str) -> [Vec<u32>; 2]
where
    T: ShaderType + Debug + ReadFrom + CreateFrom,
    Vec<T>: ShaderType + WriteInto + ReadFrom + CreateFrom,
{
    const COUNT: usize = 3;
    // Every word another float, so that no two fields can be taken for each other.
    let pattern: Vec<f32> = (0..COUNT as u64 * T::min_size().get() / 4).map(|word| word as f32 + 0.5).collect();
    let mut values: Vec<T> = Vec::new();
    StorageBuffer::new(bytemuck::cast_slice::<f32, u8>(&pattern))
        .read(&mut values)
        .expect("the pattern is long enough");
    assert_eq!(values.len(), COUNT);
    let mut buffer = StorageBuffer::new(Vec::new());
    buffer.write(&values).expect("a vector grows");
    let (source, fields) = echo_source(name);
    let kinds: Vec<&str> = fields.iter().flat_map(|(_, kind)| vec![kind.as_str(); parts_of(kind).len()]).collect();
    let device =
        Compute::new(gpu(), "echo", &source).run(gpu(), COUNT as u32, &[buffer.into_inner()], 4 * COUNT * kinds.len());
    let text = format!("{values:?}").replace("Vec3", "").replace("Vec4", "");
    let numbers: Vec<&str> =
        text.split(|c: char| !c.is_ascii_digit() && c != '.').filter(|word| !word.is_empty()).collect();
    let rust = numbers.iter().zip(kinds.iter().cycle()).map(|(number, kind)| match *kind {
        "u32" => number.parse().expect("a whole number"),
        _ => number.parse::<f32>().expect("a number").to_bits(),
    });
    [device, rust.collect()]
}

macro_rules! echoes {
    ($($name:ident),*) => {
        [$((stringify!($name), echo::<structs::$name>(stringify!($name)))),*]
    };
}

#[test]
fn the_device_reads_the_fields_that_encase_wrote() {
    for (name, [device, rust]) in for_every_struct!(echoes) {
        assert_eq!(device, rust, "{name}");
    }
}

/// The saboteur: two fields of the WGSL swapped, as a careless edit would.
#[test]
fn a_swapped_field_is_found() {
    let (source, _) = echo_source("Limit");
    let swapped =
        source.replacen("rest_length: f32", "swap: f32", 1).replacen("max_length: f32", "rest_length: f32", 1);
    let swapped = swapped.replacen("swap: f32", "max_length: f32", 1);
    assert_ne!(source, swapped);
    let items: Vec<u8> = bytemuck::cast_slice(&[1.0f32, 2.0, 3.0, 4.0]).to_vec();
    let right = Compute::new(gpu(), "echo", &source).run(gpu(), 1, std::slice::from_ref(&items), 16);
    let wrong = Compute::new(gpu(), "echo", &swapped).run(gpu(), 1, &[items], 16);
    assert_ne!(right, wrong);
}

#[test]
fn kernel_interfaces() {
    let mut text = String::new();
    for row in TABLE {
        let interface = Interface::of(row.kernel);
        let [x, y, z] = interface.workgroup_size;
        writeln!(
            text,
            "{} ({:?}, per {:?}, needs {:?}), workgroup {x}×{y}×{z}",
            interface.entry, row.stage, row.domain, row.need
        )
        .expect("text");
        for binding in &interface.bindings {
            let what = match binding.resource {
                Resource::Uniform { size } => format!("uniform, {size} bytes"),
                Resource::Storage { written: false, stride } => format!("read, {stride} bytes each"),
                Resource::Storage { written: true, stride } => format!("written, {stride} bytes each"),
                Resource::DepthTexture => "depth texture".to_owned(),
                Resource::FloatTexture => "float texture".to_owned(),
                Resource::FlatTexture { whole: false } => "flat texture of floats".to_owned(),
                Resource::FlatTexture { whole: true } => "flat texture of whole numbers".to_owned(),
                Resource::WrittenTexture { whole: false } => "written texture of floats".to_owned(),
                Resource::WrittenTexture { whole: true } => "written texture of whole numbers".to_owned(),
            };
            writeln!(text, "  {} {}: {what}", binding.number, binding.name).expect("text");
        }
    }
    insta::assert_snapshot!(text);
}
