use super::{Layout, Pattern, draw};
use glam::{DVec2, DVec3};
use toile::files::parse_garment;
use toile::model::{Level, Merge, Model};
use toile::scene::{Fabric, Pin, Settings, Sheet};

fn settings() -> Settings {
    let mut settings = Settings::new(Fabric::preset("cotton").expect("a preset"));
    settings.spacing = 0.03;
    settings
}

/// The skirt has darts, so that its panels are also sewn to themselves.
fn skirt() -> Pattern {
    let text = include_str!("../../../../fixtures/garments/skirt.json");
    let garment = parse_garment(text, "skirt").expect("it is whole").garment;
    let open = Model::from_garment(&garment, &settings()).expect("it meshes");
    let (sewn, merge) = open.sewn();
    Pattern { name: garment.name, open, sewn: Some(sewn), merge }
}

/// A sheet that hangs on its upper corners.
fn curtain() -> Pattern {
    let columns = 13;
    let mut sheet = Sheet::new("a < b & c", [columns, 9], DVec2::new(0.05 * f64::from(columns - 1), 0.4));
    sheet.down = DVec3::NEG_Y;
    sheet.pins = [0, columns - 1].map(|column| Pin { column, row: 0 }).to_vec();
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

/// Limits of a level that lie in one panel.
fn inside(pattern: &Pattern, level: &Level) -> usize {
    let cloth = pattern.cloth();
    let layout = Layout::new(pattern, 0.0);
    let steps = |ends: &[u32; 2]| layout.steps(&ends.map(|node| cloth.site(node)));
    cloth.level_limits(level).keys().filter(|ends| !steps(ends).is_empty()).count()
}

#[test]
fn every_limit_of_a_garment_is_drawn_inside_the_picture() {
    let pattern = skirt();
    let cloth = pattern.cloth();
    let svg = draw(&[skirt()]);
    assert!(cloth.levels.len() > 3, "the test sees something");
    for (level, index) in cloth.levels.iter().zip(0..3) {
        let drawn = inside(&pattern, level);
        assert!(2 * drawn > cloth.level_limits(level).len(), "most limits go over no seam");
        assert_eq!(lines(&svg, &format!("level{index}\"")).len(), drawn);
    }
    // Two sides of each of nine seams, and the hem; the band is open above.
    assert_eq!(svg.matches("class=\"number\"").count(), 2 * pattern.open.seam_names.len());
    check(pattern);
}

#[test]
fn a_sheet_shows_what_its_pins_hold() {
    let pattern = curtain();
    let svg = draw(&[curtain()]);
    assert_eq!(lines(&svg, "attachment").len(), 2 * (13 * 9 - 2));
    // Warp, weft and both diagonals.
    assert_eq!(lines(&svg, "level0").len(), 13 * 8 + 12 * 9 + 2 * 12 * 8);
    // Every second particle of both directions: 7 × 5.
    assert_eq!(svg.matches("<circle class=\"level1\"").count(), 35);
    assert_eq!(lines(&svg, "level1").len(), 7 * 4 + 6 * 5 + 2 * 6 * 4);
    assert!(svg.contains("a &lt; b &amp; c"), "a name is no tag");
    assert_eq!(step_count(&lines(&svg, "edge")), 2 * (12 + 8));
    check(pattern);
}

#[test]
fn cloths_lie_below_one_another() {
    let [one, both] = [draw(&[skirt()]), draw(&[skirt(), curtain()])];
    for class in ["level0", "level1", "level2"] {
        assert_eq!(lines(&both, class)[..lines(&one, class).len()], lines(&one, class), "the first stays where it is");
    }
    check(skirt());
}
