// The sum over a workgroup in one fixed order, so that it has the same bits on every run.
var<workgroup> terms: array<f32, 64>;

fn workgroup_sum(local: u32, term: f32) -> f32 {
    terms[local] = term;
    for (var stride = 32u; stride > 0u; stride = stride / 2u) {
        workgroupBarrier();
        if local < stride {
            terms[local] = terms[local] + terms[local + stride];
        }
    }
    return terms[0];
}
