use super::{Drawing, Layout, Pattern, draw};
use glam::{DVec2, DVec3};
use toile::files::parse_garment;
use toile::model::{Merge, Model};
use toile::scene::{Fabric, Pin, Settings, Sheet};

fn settings() -> Settings {
    Settings { spacing: 0.03, ..Settings::new(Fabric::preset("cotton").expect("a preset")) }
}

/// The skirt has darts, so that its panels are also sewn to themselves.
fn skirt() -> Pattern {
    let text = include_str!("../../../../fixtures/garments/skirt.json");
    let garment = parse_garment(text, "skirt").expect("it is whole");
    let open = Model::from_garment(&garment, &settings()).expect("it meshes");
    let (sewn, merge) = open.sewn();
    Pattern { name: garment.name, open, sewn: Some(sewn), merge }
}

fn curtain() -> Pattern {
    hung(13)
}

/// A sheet of so many columns that hangs on its upper corners.
fn hung(columns: u32) -> Pattern {
    let sheet = Sheet {
        name: "a < b & c".to_owned(),
        columns,
        rows: 9,
        size: DVec2::new(0.05 * f64::from(columns - 1), 0.4),
        corner: DVec3::ZERO,
        right: DVec3::X,
        down: DVec3::NEG_Y,
        pins: [0, columns - 1].map(|column| Pin { column, row: 0 }).to_vec(),
    };
    let open = Model::from_sheet(&sheet, &settings());
    let merge = Merge::identity(open.particle_count());
    Pattern { name: sheet.name, open, sewn: None, merge }
}

/// The data of every line of a class.
fn lines<'a>(svg: &'a str, class: &str) -> Vec<&'a str> {
    let start = format!("<path class=\"{class}");
    let data = |line: &'a str| line.split("d=\"").nth(1).and_then(|rest| rest.split('"').next());
    svg.lines().filter(|line| line.starts_with(&start)).filter_map(data).collect()
}

fn step_count(lines: &[&str]) -> usize {
    lines.iter().map(|data| data.matches('L').count()).sum()
}

fn check(pattern: Pattern) {
    let svg = draw(&[pattern]);
    let width = svg.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next()).expect("a size");
    let size: Vec<f32> = width.split(' ').map(|number| number.parse().expect("a number")).collect();
    let drawn = lines(&svg, "");
    for data in &drawn {
        assert!(data.starts_with('M') && data.contains('L'), "a line without a step: {data:?}");
        for place in data.split(['M', 'L']).skip(1) {
            let place: Vec<f32> = place.split(' ').map(|number| number.parse().expect("a number")).collect();
            assert!(
                (0.0..=size[0]).contains(&place[0]) && (0.0..=size[1]).contains(&place[1]),
                "{place:?} of {size:?}"
            );
        }
    }
}

#[test]
fn every_limit_of_a_garment_is_drawn_inside_the_picture() {
    let pattern = skirt();
    let cloth = pattern.cloth();
    let svg = draw(&[skirt()]);
    let strands = lines(&svg, "strand");
    let steps: usize = cloth.strands.iter().map(|strand| strand.particles.len() - 1).sum();
    assert!(cloth.strands.len() > 50 && cloth.loose_limits().count() > 100, "the test sees something");
    assert_eq!(strands.len(), cloth.strands.len());
    assert_eq!(step_count(&strands), steps);
    assert_eq!(lines(&svg, "long").len(), cloth.strands.len());
    assert_eq!(lines(&svg, "loose").len(), cloth.loose_limits().count());
    // Two sides of each of nine seams, and the hem; the band is open above.
    assert_eq!(svg.matches("class=\"number\"").count(), 2 * pattern.open.seam_names.len());
    check(pattern);
}

#[test]
fn strands_and_loose_limits_go_along_sides_and_diagonals_of_the_panels() {
    let pattern = skirt();
    let layout = Layout::new(&pattern, 0.0);
    let cloth = pattern.cloth();
    let drawing = Drawing { pattern: &pattern, layout: &layout, svg: &mut String::new() };
    let strands = cloth.strands.iter().flat_map(|strand| {
        let particles = strand.particles.start as usize..strand.particles.end as usize;
        layout.steps(&cloth.strand_particles[particles])
    });
    let loose = cloth.loose_limits().flat_map(|limit| drawing.loose(limit));
    for step in strands.chain(loose) {
        let mut near = pattern.open.particle_quads.row(step[0] as usize).iter();
        let inside = near.any(|quad| pattern.open.quads[*quad as usize].contains(&step[1]));
        assert!(inside, "{step:?} leads over a dart");
    }
}

#[test]
fn a_sheet_shows_what_its_pins_hold() {
    let pattern = curtain();
    let svg = draw(&[curtain()]);
    assert_eq!(lines(&svg, "attachment").len(), 2 * (13 * 9 - 2));
    assert_eq!(lines(&svg, "strand").len(), pattern.open.strands.len());
    assert_eq!(lines(&svg, "loose").len(), pattern.open.loose_limits().count());
    assert!(svg.contains("a &lt; b &amp; c"), "a name is no tag");
    assert_eq!(step_count(&lines(&svg, "edge")), 2 * (12 + 8));
    check(pattern);
}

#[test]
fn a_line_of_several_strands_is_drawn_once_from_edge_to_edge() {
    let pattern = hung(600);
    assert!(pattern.open.strands.iter().any(|strand| strand.stride > 1), "the test sees something");
    let svg = draw(&[hung(600)]);
    // Two strands along each row, a gap of an edge between them; one along each column, and the diagonals of eight and seven cells.
    assert_eq!(step_count(&lines(&svg, "strand weft")), 9 * (600 - 2));
    assert_eq!(step_count(&lines(&svg, "strand warp")), 600 * 8);
    assert_eq!(step_count(&lines(&svg, "strand diagonal")), 2 * ((600 - 8) * 8 + 2 * 7));
    assert_eq!(lines(&svg, "loose").len(), pattern.open.loose_limits().count());
    check(pattern);
}

#[test]
fn cloths_lie_below_one_another() {
    let [one, both] = [draw(&[skirt()]), draw(&[skirt(), curtain()])];
    for class in ["strand", "loose", "long"] {
        assert_eq!(lines(&both, class)[..lines(&one, class).len()], lines(&one, class), "the first stays where it is");
    }
    check(skirt());
}
