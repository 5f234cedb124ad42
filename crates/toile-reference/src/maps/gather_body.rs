//! A mesh that the host skins, out of the host's own buffers.

use glam::Vec3;

/// Three numbers of each vertex among the words of a buffer.
#[derive(Clone, Copy, Debug)]
pub struct Attribute<'a> {
    /// The buffer.
    pub words: &'a [f32],
    /// First word of the first vertex.
    pub first: usize,
    /// Words from one vertex to the next.
    pub stride: usize,
}

/// How the host tells the motion of its vertices.
#[derive(Clone, Copy, Debug)]
pub enum HostMotion<'a> {
    /// By velocities [m/s].
    Velocities(Attribute<'a>),
    /// By the positions before [m].
    LastPositions(Attribute<'a>),
}

impl Attribute<'_> {
    fn at(&self, vertex: usize) -> Vec3 {
        let first = self.first + vertex * self.stride;
        Vec3::from_slice(&self.words[first..first + 3])
    }
}

/// Positions [m] and unit normals, each of shape [vertex_count], as they will be `ahead`: in seconds by velocities, in ways from the positions before. A
/// normal without length becomes +y.
pub fn gather_body(
    vertex_count: usize,
    positions: Attribute<'_>,
    normals: Attribute<'_>,
    motion: HostMotion<'_>,
    ahead: f32,
) -> [Vec<Vec3>; 2] {
    let gone = |vertex| {
        let position = positions.at(vertex);
        let way = match motion {
            HostMotion::Velocities(velocities) => velocities.at(vertex),
            HostMotion::LastPositions(last) => position - last.at(vertex),
        };
        position + way * ahead
    };
    let unit = |vertex| {
        let normal: Vec3 = normals.at(vertex);
        let length = normal.length();
        if length > 0.0 { normal / length } else { Vec3::Y }
    };
    [(0..vertex_count).map(gone).collect(), (0..vertex_count).map(unit).collect()]
}
