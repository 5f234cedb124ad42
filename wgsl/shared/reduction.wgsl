// The sum over a workgroup in one fixed order, so that it has the same bits on every run. Every invocation gets it.
var<workgroup> terms: array<f32, 64>;

fn workgroup_sum(local: u32, term: f32) -> f32 {
    // What an earlier sum left may still be read.
    workgroupBarrier();
    terms[local] = term;
    for (var stride = 32u; stride > 0u; stride = stride / 2u) {
        workgroupBarrier();
        if local < stride {
            terms[local] = terms[local] + terms[local + stride];
        }
    }
    workgroupBarrier();
    return terms[0];
}
