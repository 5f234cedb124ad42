//! The extensions of glTF: what is read, what does not touch the shape, and what is refused by name.

use crate::error::{Found, Place};
use crate::unread::{Unread, shortened};
use serde_json::Value;
use std::collections::BTreeSet;

/// What is done with an extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Use {
    /// It is read.
    Read,
    /// It does not touch the shape of the surface, for this reason.
    Shapeless(&'static str),
    /// Files that need it are refused; what to do instead. A file that does not need it has the shape without it, too.
    Refused(&'static str),
}

const MATERIAL: Use = Use::Shapeless("it says how a surface looks");
const TEXTURE: Use = Use::Shapeless("it says how an image is kept");
const LIGHT: Use = Use::Shapeless("it lights the scene");
const NOTES: Use = Use::Shapeless("it has notes about the file or its parts");
const BEHAVIOUR: Use = Use::Shapeless("it says what a program does with the file while it runs");
const LINES: Use = Use::Shapeless("it draws lines on the edges of triangles");
/// What it groups also stands in the file by itself.
const RESTART: Use = Use::Shapeless("it draws several parts of a mesh at once");
const SPLATS: Use = Use::Refused("make a mesh of the splats");
const STREAM: Use = Use::Refused("export the numbers themselves, not a stream of them");

/// The extensions that the registry of Khronos has ratified, those that are in work or of several vendors, all of single
/// vendors there, the archived ones, and those that exporters of bodies write beside it.
const EXTENSIONS: &[(&str, Use)] = &[
    // Ratified.
    ("KHR_animation_pointer", Use::Read),
    ("KHR_draco_mesh_compression", Use::Read),
    ("KHR_lights_punctual", LIGHT),
    ("KHR_materials_anisotropy", MATERIAL),
    ("KHR_materials_clearcoat", MATERIAL),
    ("KHR_materials_dispersion", MATERIAL),
    ("KHR_materials_emissive_strength", MATERIAL),
    ("KHR_materials_ior", MATERIAL),
    ("KHR_materials_iridescence", MATERIAL),
    ("KHR_materials_sheen", MATERIAL),
    ("KHR_materials_specular", MATERIAL),
    ("KHR_materials_transmission", MATERIAL),
    ("KHR_materials_unlit", MATERIAL),
    ("KHR_materials_variants", MATERIAL),
    ("KHR_materials_volume", MATERIAL),
    ("KHR_mesh_quantization", Use::Read),
    ("KHR_node_visibility", Use::Read),
    ("KHR_texture_basisu", TEXTURE),
    ("KHR_texture_transform", TEXTURE),
    ("KHR_xmp_json_ld", NOTES),
    ("EXT_mesh_gpu_instancing", Use::Refused("make the instances real before the export")),
    ("EXT_meshopt_compression", Use::Read),
    ("EXT_texture_webp", TEXTURE),
    // In work, by Khronos or several vendors.
    ("KHR_accessor_float64", Use::Refused("export numbers as 32-bit floats")),
    ("KHR_audio_emitter", BEHAVIOUR),
    ("KHR_audio_graph", BEHAVIOUR),
    ("KHR_collision_shapes", BEHAVIOUR),
    ("KHR_gaussian_splatting", SPLATS),
    ("KHR_gaussian_splatting_compression_spz_2", SPLATS),
    ("KHR_implicit_shapes", Use::Shapeless("its shapes are for collisions and are not drawn")),
    ("KHR_interactivity", BEHAVIOUR),
    ("KHR_materials_clearcoat_darkening", MATERIAL),
    ("KHR_materials_coat", MATERIAL),
    ("KHR_materials_diffuse_roughness", MATERIAL),
    ("KHR_materials_diffuse_transmission", MATERIAL),
    ("KHR_materials_fuzz", MATERIAL),
    ("KHR_materials_openpbr", MATERIAL),
    ("KHR_materials_sss", MATERIAL),
    ("KHR_materials_subsurface", MATERIAL),
    ("KHR_materials_volume_scatter", MATERIAL),
    ("KHR_meshopt_compression", Use::Read),
    ("KHR_mesh_primitive_restart", RESTART),
    ("KHR_node_hoverability", BEHAVIOUR),
    ("KHR_node_selectability", BEHAVIOUR),
    ("KHR_physics_rigid_bodies", BEHAVIOUR),
    ("KHR_texture_procedurals", TEXTURE),
    ("KHR_texture_video", TEXTURE),
    ("EXT_instance_features", NOTES),
    ("EXT_lights_ies", LIGHT),
    ("EXT_lights_image_based", LIGHT),
    ("EXT_mesh_features", NOTES),
    ("EXT_mesh_manifold", NOTES),
    ("EXT_mesh_polygon", Use::Refused("export triangles")),
    ("EXT_mesh_primitive_edge_visibility", LINES),
    ("EXT_mesh_primitive_restart", RESTART),
    ("EXT_primitive_voxels", Use::Refused("make a mesh of the voxels")),
    ("EXT_structural_metadata", NOTES),
    ("EXT_texture_astc", TEXTURE),
    ("EXT_texture_avif", TEXTURE),
    ("EXT_texture_procedurals_mx_1_39", TEXTURE),
    // Of single vendors.
    ("ADOBE_materials_clearcoat_specular", MATERIAL),
    ("ADOBE_materials_clearcoat_tint", MATERIAL),
    ("ADOBE_materials_thin_transparency", MATERIAL),
    ("AGI_articulations", Use::Refused("bake the first values of its articulations into the nodes")),
    ("AGI_stk_metadata", NOTES),
    ("CESIUM_primitive_outline", LINES),
    ("CESIUM_RTC", Use::Refused("export glTF 2.0 with positions near the origin")),
    ("FB_geometry_metadata", NOTES),
    ("FB_ngon_encoding", Use::Shapeless("it says which triangles were a polygon")),
    ("GODOT_single_root", NOTES),
    ("GRIFFEL_bim_data", NOTES),
    ("MESHOPT_compression", Use::Read),
    ("MPEG_accessor_timed", STREAM),
    ("MPEG_animation_timing", STREAM),
    ("MPEG_audio_spatial", BEHAVIOUR),
    ("MPEG_buffer_circular", STREAM),
    ("MPEG_media", BEHAVIOUR),
    ("MPEG_mesh_linking", STREAM),
    ("MPEG_scene_dynamic", STREAM),
    ("MPEG_texture_video", TEXTURE),
    ("MPEG_viewport_recommended", BEHAVIOUR),
    ("MSFT_lod", Use::Shapeless("it names coarser copies, which are not in the scene")),
    ("MSFT_packing_normalRoughnessMetallic", TEXTURE),
    ("MSFT_packing_occlusionRoughnessMetallic", TEXTURE),
    ("MSFT_texture_dds", TEXTURE),
    ("NV_materials_mdl", MATERIAL),
    ("VRM", BEHAVIOUR),
    ("VRMC_materials_hdr_emissiveMultiplier", MATERIAL),
    ("VRMC_materials_mtoon", MATERIAL),
    ("VRMC_node_constraint", BEHAVIOUR),
    ("VRMC_springBone", BEHAVIOUR),
    ("VRMC_springBone_extended_collider", BEHAVIOUR),
    ("VRMC_vrm", BEHAVIOUR),
    ("VRMC_vrm_animation", BEHAVIOUR),
    // Archived, or of glTF 1.0.
    ("KHR_lights_common", LIGHT),
    ("KHR_materials_common", MATERIAL),
    ("KHR_materials_pbrSpecularGlossiness", MATERIAL),
    ("KHR_techniques_webgl", MATERIAL),
    ("KHR_xmp", NOTES),
];

fn use_of(name: &str) -> Option<Use> {
    EXTENSIONS.iter().find(|(known, _)| *known == name).map(|(_, of)| *of)
}

/// Refuses the extensions that the file needs and nothing reads; notes those that it could do without.
pub(crate) fn check(root: &Value, unread: &mut Unread) -> Result<(), Found> {
    let listed = |key: &str| -> BTreeSet<String> {
        let names = root.get(key).and_then(Value::as_array).into_iter().flatten();
        names.filter_map(Value::as_str).map(String::from).collect()
    };
    for name in listed("extensionsRequired") {
        let advice = match use_of(&name) {
            Some(Use::Read | Use::Shapeless(_)) => continue,
            Some(Use::Refused(advice)) => advice,
            None => "export it without it",
        };
        return Err(refusal("the file", shortened(&name), advice));
    }
    for name in listed("extensionsUsed") {
        if use_of(&name).is_none() {
            unread.note(&format!("the extension {}", shortened(&name)), || Place::File);
        }
    }
    Ok(())
}

/// Refuses a thing that cannot be read without the extension.
pub(crate) fn refuse(what: &str, name: &str) -> Found {
    let advice = match use_of(name) {
        Some(Use::Refused(advice)) => advice,
        Some(Use::Read | Use::Shapeless(_)) | None => "export it without it",
    };
    refusal(what, name, advice)
}

fn refusal(what: &str, name: &str, advice: &str) -> Found {
    Found::malformed(Place::File, format!("{what} needs the extension {name}, which is not read: {advice}"))
}

/// Whether the extension is one whose absence changes no shape.
pub(crate) fn is_known(name: &str) -> bool {
    use_of(name).is_some()
}

#[cfg(test)]
mod tests {
    use super::{EXTENSIONS, Use, check, use_of};
    use crate::unread::Unread;
    use serde_json::json;

    /// What the registry of Khronos listed in July 2026: ratified, in work, of several vendors, of single ones, archived.
    #[rustfmt::skip]
    const REGISTRY: [&str; 69] = [
        "KHR_animation_pointer", "KHR_draco_mesh_compression", "KHR_lights_punctual", "KHR_materials_anisotropy",
        "KHR_materials_clearcoat", "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior",
        "KHR_materials_iridescence", "KHR_materials_sheen", "KHR_materials_specular", "KHR_materials_transmission",
        "KHR_materials_unlit", "KHR_materials_variants", "KHR_materials_volume", "KHR_mesh_quantization",
        "KHR_node_visibility", "KHR_texture_basisu", "KHR_texture_transform", "KHR_xmp_json_ld", "EXT_mesh_gpu_instancing",
        "EXT_meshopt_compression", "EXT_texture_webp",
        "KHR_accessor_float64", "KHR_audio_graph", "KHR_collision_shapes", "KHR_gaussian_splatting", "KHR_interactivity",
        "KHR_materials_diffuse_transmission", "KHR_materials_subsurface", "KHR_meshopt_compression",
        "KHR_node_hoverability", "KHR_node_selectability", "KHR_physics_rigid_bodies", "KHR_texture_procedurals",
        "EXT_texture_procedurals_mx_1_39", "KHR_texture_video",
        "EXT_lights_ies", "EXT_lights_image_based", "EXT_mesh_manifold", "EXT_mesh_primitive_edge_visibility",
        "EXT_mesh_primitive_restart", "EXT_texture_astc",
        "ADOBE_materials_clearcoat_specular", "ADOBE_materials_clearcoat_tint", "ADOBE_materials_thin_transparency",
        "AGI_articulations", "AGI_stk_metadata", "CESIUM_primitive_outline", "FB_geometry_metadata", "GODOT_single_root",
        "GRIFFEL_bim_data", "MPEG_accessor_timed", "MPEG_animation_timing", "MPEG_audio_spatial", "MPEG_buffer_circular",
        "MPEG_media", "MPEG_mesh_linking", "MPEG_scene_dynamic", "MPEG_texture_video", "MPEG_viewport_recommended",
        "MSFT_lod", "MSFT_packing_normalRoughnessMetallic", "MSFT_packing_occlusionRoughnessMetallic", "MSFT_texture_dds",
        "NV_materials_mdl", "KHR_materials_pbrSpecularGlossiness", "KHR_techniques_webgl", "KHR_xmp",
    ];

    #[test]
    fn every_extension_of_the_registry_is_known_and_no_name_stands_twice() {
        for name in REGISTRY {
            assert!(use_of(name).is_some(), "{name}");
        }
        let mut names: Vec<&str> = EXTENSIONS.iter().map(|(name, _)| *name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), EXTENSIONS.len());
    }

    #[test]
    fn what_is_needed_and_not_read_is_refused_by_name_and_the_rest_is_told() {
        for (name, of) in EXTENSIONS.iter().copied().chain([("ACME_shape", Use::Refused("export it without it"))]) {
            let mut unread = Unread::default();
            let found = check(&json!({ "extensionsUsed": [name], "extensionsRequired": [name] }), &mut unread);
            match (of, found) {
                (Use::Read | Use::Shapeless(_), Ok(())) => assert_eq!(unread.sentences().count(), 0, "{name}"),
                (Use::Refused(advice), Err(found)) => {
                    let told = found.in_file("a.glb").to_string();
                    let expected = format!("a.glb: the file needs the extension {name}, which is not read: {advice}");
                    assert_eq!(told, expected);
                }
                (of, found) => panic!("{name} {of:?} {found:?}"),
            }
        }
        let mut unread = Unread::default();
        check(&json!({ "extensionsUsed": ["ACME_shape", "KHR_materials_ior"] }), &mut unread).expect("none is needed");
        assert_eq!(unread.sentences().collect::<Vec<_>>(), ["not read: the extension ACME_shape"]);
    }
}
