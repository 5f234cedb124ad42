// A line of cloth and the limits along it.
struct Strand {
    first: u32,         // of its particles
    count: u32,         // particles
    lengths: u32,       // first of its maximum lengths
    level_count: u32,   // limits over 1, 2, 4… steps from particle to particle
}
