// Further sweeps in the steps that need them, and a bound on them.
#import struct/Polish
#import struct/PolishState

@group(0) var<uniform> polish: Polish;
@group(0) var<storage, read_write> polish_state: PolishState;
