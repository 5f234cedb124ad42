//! The garments of a simulation that are dressed, and the one that is being dressed.

use crate::fitting::Fitting;
use crate::outfit::{Part, Recorder};
use crate::{Cloth, Error};
use glam::{Vec3, Vec4};
use toile_gpu::Arrival;
use toile_model::Dressing;
use toile_scene::Mesh;

/// Garments that are dressed, from the inside out, and the one that is being dressed.
#[derive(Debug, Default)]
pub(crate) struct Dressed {
    pub(crate) done: Vec<Done>,
    pub(crate) fitting: Option<Fitting>,
}

/// A garment that is dressed.
#[derive(Debug)]
pub(crate) struct Done {
    pub(crate) cloth: Cloth,
    pub(crate) dressing: Dressing,
    /// How its particles moved at last [m/s], shape [particle_count]; empty where that is not known.
    #[cfg_attr(not(feature = "native-wait"), expect(dead_code, reason = "only what waits for the device reads it"))]
    pub(crate) velocities: Vec<Vec3>,
    pub(crate) bounds: Bounds,
}

/// The box around a dressed garment, which the maps of the next one need.
#[derive(Debug)]
pub(crate) enum Bounds {
    Unknown,
    UnderWay(Arrival),
    Known([Vec3; 2]),
}

impl Dressed {
    /// The boxes around all garments that are dressed, if they are known; otherwise they are asked for, and arrive with a later call.
    pub(crate) fn known_bounds(
        &mut self,
        device: &wgpu::Device,
        recorder: &mut Recorder<'_>,
    ) -> Result<Option<Vec<[Vec3; 2]>>, Error> {
        for Done { cloth, bounds, .. } in &mut self.done {
            if let Bounds::UnderWay(arrival) = bounds {
                if let Some(bytes) = arrival.take() {
                    let positions = bytemuck::pod_collect_to_vec::<u8, Vec4>(&bytes);
                    let mesh = Mesh { positions: positions.iter().map(|p| p.truncate()).collect(), ..Mesh::default() };
                    *bounds = Bounds::Known(mesh.bounds().unwrap_or_default());
                } else if arrival.is_over() {
                    *bounds = Bounds::Unknown;
                }
            }
            if matches!(bounds, Bounds::Unknown) {
                recorder(Part::Steps, &mut |encoder| {
                    *bounds = Bounds::UnderWay(Arrival::of(device, encoder, &cloth.frame().positions));
                })?;
            }
        }
        Ok(self.done.iter().map(|done| done.bounds.known()).collect())
    }
}

impl Bounds {
    /// The box, where it has arrived.
    pub(crate) fn known(&self) -> Option<[Vec3; 2]> {
        match self {
            Bounds::Known(bounds) => Some(*bounds),
            Bounds::Unknown | Bounds::UnderWay(_) => None,
        }
    }
}
