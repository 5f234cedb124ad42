// The numbers of one step, the same for every particle.
#import struct/StepParams

const COULOMB: u32 = 0u;

@group(0) var<uniform> step: StepParams;
