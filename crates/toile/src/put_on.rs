//! A cloth that another simulation has dressed, put on while a run goes on.

use crate::kept_maps::maps_of_round;
use crate::outfit::Outfit;
use crate::simulation::{Phase, Simulation};
use crate::stage::Stage;
use crate::{Control, Error};
use glam::{DVec3, Vec3};
use toile_model::Piece;
use toile_scene::{Cloth as Cut, Mesh, Motion};

/// How long the other run may be behind and is caught up with at once [s].
const CAUGHT_UP_SECONDS: f64 = 0.25;

/// How far the bodies of two runs may stand apart [m]: less than cloth is thick.
const APART: f32 = 1e-3;

impl Simulation {
    /// Puts on what another simulation has dressed over the cloths of this one: the fitting room. Its scene has the same bodies, the cloths of this one in
    /// their order, and after them those to put on. It goes through the same journey as any other, on the same device, while this one is drawn. Once its
    /// body stands as that of this one, this one goes on with all cloths in new buffers, at its own time and place, under its own control; a host
    /// takes [`Cloth::frame`](crate::Cloth::frame) anew then and drops the other.
    ///
    /// Cloths that both have stay as they are here. What is put on lay over the folds that they have there, so it may be pushed out of those
    /// that they have here, within some steps.
    ///
    /// The body of the other run may be up to 0.25 s behind; then its steps are recorded first. So are the steps up to the next drawing of the maps. A
    /// motion that ends as it begins may be any number of rounds behind. Where a body that the host skins stands is the host's business: in both runs
    /// at the same place.
    ///
    /// # Errors
    /// [`Error::PutOn`] when the other run has not begun, has other cloths below, another frame rate or other bodies, or its body stands elsewhere, with by how
    /// much; [`Error::Gpu`] when all of it together does not fit the device. Then each cloth stays where it is; a host may try again later.
    ///
    /// # Panics
    /// Before the run, and when the other simulation is on another device.
    pub fn put_on(&mut self, encoder: &mut wgpu::CommandEncoder, fitting: &mut Simulation) -> Result<(), Error> {
        assert_eq!(self.device, fitting.device, "what is put on was dressed on the same device");
        self.running("a cloth is put on");
        self.check_what_is_put_on(fitting)?;
        let behind = self.catch_up_intervals(fitting)?;
        let there = fitting.running("a cloth is put on");
        let time_there = (there.intervals() + behind) as f64 * there.interval_seconds();
        let here = self.running("a cloth is put on");
        let time_here = here.intervals() as f64 * here.interval_seconds();
        self.check_poses(fitting, [time_here, time_there])?;
        let rest = self.running("a cloth is put on").rest_of_interval();
        fitting.go_ahead(encoder, behind)?;
        self.go_ahead(encoder, rest)?;
        self.join(encoder, fitting)
    }

    /// Records parts of the run before they are asked for.
    fn go_ahead(&mut self, encoder: &mut wgpu::CommandEncoder, parts: u64) -> Result<(), Error> {
        let device = self.device.clone();
        let outfit = self.running("a cloth is put on");
        let done = outfit.done();
        outfit.record(&device, done..done + parts, &mut |_, record| {
            record(encoder);
            Ok(())
        })?;
        self.clock = self.clock.ahead(parts);
        Ok(())
    }

    /// Whether the other run is one of the same bodies and cloths, and has some more.
    fn check_what_is_put_on(&self, fitting: &Simulation) -> Result<(), Error> {
        let refused = |why: String| Err(Error::PutOn(why));
        if !matches!(fitting.phase, Phase::Together { stage: Stage::Running, .. }) {
            return refused("it is still being dressed".to_owned());
        }
        let told = |pieces: &[Piece]| -> Vec<String> {
            let told = |piece: &Piece| format!("{} with {} particles", piece.name, piece.model.particle_count());
            pieces.iter().map(told).collect()
        };
        let (here, there) = (told(&self.pieces), told(&fitting.pieces));
        if !there.starts_with(&here) {
            return refused(format!(
                "here are {}, and it was dressed over others: {}",
                here.join(", "),
                there.join(", ")
            ));
        }
        if here.len() == there.len() {
            return refused("the other run has no further cloth".to_owned());
        }
        let [rate_here, rate_there] = [self.settings.frame_rate, fitting.settings.frame_rate];
        if rate_here != rate_there {
            return refused(format!("it runs at {rate_there} frames per second, and this one at {rate_here}"));
        }
        let counts = |simulation: &Simulation| [simulation.bodies.still.len(), simulation.bodies.moving.len()];
        let are_same = counts(self) == counts(fitting)
            && self.bodies.still.iter().zip(&fitting.bodies.still).all(|(here, there)| here == there);
        if are_same { Ok(()) } else { refused("it was dressed on other bodies".to_owned()) }
    }

    /// Intervals that the other run is behind.
    fn catch_up_intervals(&mut self, fitting: &mut Simulation) -> Result<u64, Error> {
        let [here, there] = [&mut *self, &mut *fitting].map(|simulation| {
            let outfit = simulation.running("a cloth is put on");
            (outfit.intervals() as i64, outfit.interval_seconds())
        });
        let interval = here.1;
        if self.bodies.moving.iter().all(|body| matches!(body.motion, Motion::Hosted)) {
            return Ok(0);
        }
        let mut behind = here.0 - there.0;
        if let [body] = self.bodies.moving.as_slice()
            && let Some(round) = maps_of_round(body, interval)
        {
            behind = behind.rem_euclid(i64::from(round));
        }
        let seconds = behind as f64 * interval;
        if behind < 0 {
            return Err(Error::PutOn(format!(
                "its body is {:.3} s ahead of this one: advance this one alone",
                -seconds
            )));
        }
        if seconds > CAUGHT_UP_SECONDS {
            return Err(Error::PutOn(format!(
                "its body is {seconds:.3} s behind this one: advance it by as much, and then both"
            )));
        }
        Ok(behind as u64)
    }

    /// Whether the bodies of both runs stand alike at these times [s].
    fn check_poses(&self, fitting: &Simulation, [here, there]: [f64; 2]) -> Result<(), Error> {
        for (one, other) in self.bodies.moving.iter().zip(&fitting.bodies.moving) {
            let [one, other]: [Mesh; 2] = [one.at(here), other.at(there)];
            let apart = |(a, b): (&Vec3, &Vec3)| a.distance(*b);
            let farthest = one.positions.iter().zip(&other.positions).map(apart).fold(0.0, f32::max);
            if one.positions.len() != other.positions.len() || farthest.is_nan() || farthest > APART {
                return Err(Error::PutOn(format!(
                    "its body stands up to {farthest:.4} m from where this one does: it is another one, or in another motion"
                )));
            }
        }
        Ok(())
    }

    /// Has all cloths go on here.
    fn join(&mut self, encoder: &mut wgpu::CommandEncoder, fitting: &mut Simulation) -> Result<(), Error> {
        let first = self.pieces.len();
        let (there, bounds) = match &fitting.phase {
            Phase::Together { outfit, garment_bounds, .. } => (outfit, garment_bounds.clone()),
            Phase::Dressing(_) => return Err(Error::PutOn("it is still being dressed".to_owned())),
        };
        let way = self.place() - there.place();
        let before =
            Before { pieces: self.pieces.clone(), cloths: self.scene_cloths.clone(), control: self.control.clone() };
        for (index, piece) in fitting.pieces.iter().enumerate().skip(first) {
            let fabric = &fitting.control.fabrics[index];
            let mut piece = piece.clone();
            piece.take_numbers(&self.settings, fabric);
            self.pieces.push(piece);
            self.scene_cloths.push(fitting.scene_cloths[index].clone());
            self.control.fabrics.push(fabric.clone());
            let along = if fitting.pieces[index].open.is_some() { way } else { DVec3::ZERO };
            let pins = fitting.control.pins[index].iter().map(|(particle, place)| (*particle, *place + along));
            self.control.pins.push(pins.collect());
        }
        let ratio = self.running("a cloth is put on").parts_of_interval();
        let joined = self.in_boxes_of_all(bounds).and_then(|()| self.go_on_in_new_buffers(encoder));
        if let Err(error) = joined {
            (self.pieces, self.scene_cloths, self.control) = (before.pieces, before.cloths, before.control);
            self.in_boxes_of_all(Vec::new())?;
            return Err(error);
        }
        self.clock = self.clock.in_longer_parts(ratio);
        let (device, pins) = (self.device.clone(), self.control.pins.clone());
        let here: &mut Outfit = self.running("a cloth is put on");
        here.take_over(&device, encoder, first, there)?;
        here.set_pins(pins.iter());
        Ok(())
    }

    /// Where the maps of all cloths stand: more cloths need more room.
    fn in_boxes_of_all(&mut self, bounds: Vec<[Vec3; 2]>) -> Result<(), Error> {
        if !self.bodies.moving.is_empty() {
            self.boxes = Some(self.boxes_of_all()?);
        }
        if let Phase::Together { garment_bounds, .. } = &mut self.phase
            && garment_bounds.len() < bounds.len()
        {
            *garment_bounds = bounds;
        }
        Ok(())
    }
}

/// What is taken back where the device has no room.
struct Before {
    pieces: Vec<Piece>,
    cloths: Vec<Cut>,
    control: Control,
}
