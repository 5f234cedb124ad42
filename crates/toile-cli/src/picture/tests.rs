//! What a picture must show, on meshes whose picture is known.

use super::raster::{Corner, SUBPIXELS, scan};
use super::*;
use glam::Vec3;
use image::Rgb;

const GREEN: Material = Material { outside: [0.1, 0.8, 0.1], inside: [0.8, 0.1, 0.1], look: Look::Cloth };
const RED: Material = Material { outside: [0.8, 0.1, 0.1], inside: [0.1, 0.8, 0.1], look: Look::Skin };

/// Latitude and longitude ball.
fn ball(centre: Vec3, radius: f32) -> Mesh {
    let (rings, sectors) = (24u32, 48u32);
    let mut mesh = Mesh::default();
    for ring in 0..=rings {
        let (sin, cos) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
        for sector in 0..sectors {
            let (east, north) = (std::f32::consts::TAU * sector as f32 / sectors as f32).sin_cos();
            let normal = Vec3::new(sin * east, cos, sin * north);
            mesh.normals.push(normal);
            mesh.positions.push(centre + radius * normal);
            if ring < rings {
                let [a, b] = [sector, (sector + 1) % sectors].map(|s| ring * sectors + s);
                mesh.triangles.extend([[a, a + sectors, b], [b, a + sectors, b + sectors]]);
            }
        }
    }
    mesh
}

fn flipped(mut mesh: Mesh) -> Mesh {
    for t in &mut mesh.triangles {
        t.swap(1, 2);
    }
    for n in &mut mesh.normals {
        *n = -*n;
    }
    mesh
}

fn of_view(drawn: &[Drawn], stage: Option<[Vec3; 2]>, view: View, height: u32) -> Result<RgbImage, PictureError> {
    render(drawn, stage, &[view], height).map(|pictures| pictures.into_iter().next().expect("one view was asked for"))
}

fn picture(meshes: &[(&Mesh, Material)], view: View) -> RgbImage {
    let drawn: Vec<_> =
        meshes.iter().map(|(mesh, material)| Drawn { mesh, material: *material, thickness: 0.0 }).collect();
    of_view(&drawn, None, view, 240).expect("a finite scene has a picture")
}

fn is_green(p: &Rgb<u8>) -> bool {
    i32::from(p[1]) > i32::from(p[0]) + 25
}

fn is_red(p: &Rgb<u8>) -> bool {
    i32::from(p[0]) > i32::from(p[1]) + 25
}

fn count(image: &RgbImage, test: fn(&Rgb<u8>) -> bool) -> usize {
    image.pixels().filter(|p| test(p)).count()
}

/// Mean column of the pixels that pass a test.
fn mean_column(image: &RgbImage, test: fn(&Rgb<u8>) -> bool) -> f64 {
    let columns: f64 =
        image.enumerate_pixels().filter(|(_, _, p)| test(p)).map(|(column, _, _)| f64::from(column)).sum();
    columns / count(image, test) as f64
}

#[test]
fn a_ball_covers_its_disc() {
    let image = picture(&[(&ball(Vec3::new(3.0, -2.0, 5.0), 0.7), GREEN)], View::ThreeQuarter);
    // The frame leaves 3 % free around the upright cylinder about the ball, seen from 7 degrees above.
    let (sin, cos) = 7f64.to_radians().sin_cos();
    let radius = 0.94 * 240.0 / (2.0 * (sin + cos));
    let disc = std::f64::consts::PI * radius * radius;
    let covered = count(&image, is_green) as f64;
    // A pixel on the outline counts when a part of it shows the ball: half a pixel of the outline either way.
    assert!((covered - disc).abs() < std::f64::consts::PI * radius, "{covered} pixels, disc of {disc}");
}

#[test]
fn a_nearer_mesh_hides_a_farther_one() {
    let [near, far] = [ball(Vec3::Z, 0.5), ball(-Vec3::Z, 0.2)];
    for order in [[(&near, GREEN), (&far, RED)], [(&far, RED), (&near, GREEN)]] {
        let front = picture(&order, View::Front);
        assert_eq!(count(&front, is_red), 0);
        assert!(count(&front, is_green) > 1000);
        let back = picture(&order, View::Back);
        assert!(count(&back, is_red) > 300, "{}", count(&back, is_red));
    }
}

#[test]
fn a_mesh_inside_out_shows_the_inside() {
    let mesh = ball(Vec3::ZERO, 1.0);
    let right = picture(&[(&mesh, GREEN)], View::Front);
    assert_eq!(count(&right, is_red), 0);
    let wrong = picture(&[(&flipped(mesh), GREEN)], View::Front);
    assert_eq!(count(&wrong, is_green), 0);
    // Pixels on the outline are mixed with the background, and red stands out from it less than green.
    let [inside, outside] = [count(&wrong, is_red), count(&right, is_green)];
    assert!(inside.abs_diff(outside) * 50 < outside, "{inside} pixels inside out, {outside} otherwise");
}

#[test]
fn views_show_the_side_they_name() {
    let [left, ahead] = [ball(Vec3::X, 0.3), ball(Vec3::Z, 0.3)];
    let seen = |view| {
        let image = picture(&[(&left, GREEN), (&ahead, RED)], view);
        mean_column(&image, is_green) - mean_column(&image, is_red)
    };
    assert!(seen(View::Front) > 30.0);
    assert!(seen(View::ThreeQuarter) > 30.0);
    assert!(seen(View::Back) < -30.0);
    assert!(seen(View::Side) > 30.0);
    let side = picture(&[(&ball(Vec3::X, 0.5), GREEN), (&ball(-Vec3::X, 0.2), RED)], View::Side);
    assert_eq!(count(&side, is_red), 0);
}

#[test]
fn all_views_have_one_scale() {
    let mesh = ball(Vec3::ZERO, 0.2);
    let post = ball(Vec3::new(0.0, 0.0, 2.0), 0.2);
    let heights = [View::Front, View::Back, View::Side, View::ThreeQuarter].map(|view| {
        let image = picture(&[(&mesh, GREEN), (&post, RED)], view);
        let rows = image.enumerate_pixels().filter(|(_, _, p)| is_green(p) || is_red(p));
        let (low, high) = rows.fold((u32::MAX, 0), |(low, high), (c, _, _)| (low.min(c), high.max(c)));
        (image.dimensions(), high - low)
    });
    let [front, back, side, _] = heights;
    assert_eq!(front, back);
    // 0.4 m wide from the front, 2.4 m from the side.
    assert!(side.1.abs_diff(6 * front.1) <= 8, "{front:?} {side:?}");
}

#[test]
fn views_drawn_together_are_those_drawn_alone() {
    let [a, b] = [ball(Vec3::ZERO, 1.0), ball(Vec3::new(0.3, 0.9, 1.5), 0.6)];
    let drawn = [(&a, GREEN), (&b, RED)].map(|(mesh, material)| Drawn { mesh, material, thickness: 0.0 });
    let views = [View::Front, View::Side, View::Back];
    let together = render(&drawn, None, &views, 120).expect("a finite scene has pictures");
    for (view, picture) in views.into_iter().zip(together) {
        assert!(picture == of_view(&drawn, None, view, 120).expect("a finite scene has a picture"), "{view:?}");
    }
}

#[test]
fn what_stands_below_shades_what_faces_down() {
    let above = ball(Vec3::ZERO, 0.5);
    let plate = Mesh::cuboid(Vec3::new(-1.0, -0.6, -1.0), Vec3::new(1.0, -0.52, 1.0));
    let stage = [Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0)];
    let lowest = |meshes: &[&Mesh]| {
        let drawn: Vec<_> = meshes.iter().map(|mesh| Drawn { mesh, material: GREEN, thickness: 0.0 }).collect();
        let image = of_view(&drawn, Some(stage), View::Front, 240).expect("a finite scene has a picture");
        // In the middle column, where the ball faces down and the plate does not hide it.
        image.get_pixel(image.width() / 2, 157)[1]
    };
    let [open, shaded] = [lowest(&[&above]), lowest(&[&above, &plate])];
    assert!(shaded + 20 < open, "{shaded} above the plate, {open} without it");
}

#[test]
fn what_stands_between_throws_a_shadow() {
    let floor = Mesh {
        positions: [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| Vec3::new(x, 0.0, z)).into(),
        normals: vec![Vec3::Y; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    let above = ball(Vec3::new(0.0, 0.35, 0.0), 0.2);
    let darkest = |meshes: &[(&Mesh, Material)]| {
        let image = picture(meshes, View::Front);
        image.pixels().filter(|p| is_green(p)).map(|p| p[1]).min().expect("the floor is seen")
    };
    let open = darkest(&[(&floor, GREEN)]);
    let shaded = darkest(&[(&floor, GREEN), (&above, RED)]);
    assert!(shaded + 40 < open, "{shaded} in the shadow, {open} without it");
}

#[test]
fn a_cloth_hides_what_stands_up_by_less_than_its_thickness() {
    let [cloth, bump] = [1.0, 1.02].map(|radius| ball(Vec3::ZERO, radius));
    let reds = [0.0, 0.03].map(|thickness| {
        let drawn =
            [Drawn { mesh: &cloth, material: GREEN, thickness }, Drawn { mesh: &bump, material: RED, thickness: 0.0 }];
        count(&of_view(&drawn, None, View::Front, 240).expect("a picture"), is_red)
    });
    assert!(reds[0] > 1000 && reds[1] == 0, "{reds:?}");
}

#[test]
fn non_finite_vertices_are_refused() {
    let sound = ball(Vec3::ZERO, 1.0);
    let mut broken = sound.clone();
    broken.positions[17].y = f32::NAN;
    broken.positions[20].x = f32::INFINITY;
    broken.normals[30].z = f32::NEG_INFINITY;
    let drawn = [&sound, &broken].map(|mesh| Drawn { mesh, material: GREEN, thickness: 0.0 });
    let error = of_view(&drawn, None, View::Front, 100).expect_err("three vertices are nowhere");
    assert!(matches!(error, PictureError::NonFinite { count: 3, mesh: 1, vertex: 17 }), "{error:?}");
    assert!(error.to_string().contains("3 vertices") && error.to_string().contains("vertex 17 of mesh 1"));
}

#[test]
fn nothing_to_see_is_refused() {
    let point = Mesh { positions: vec![Vec3::ONE; 3], normals: vec![Vec3::Y; 3], triangles: vec![[0, 1, 2]] };
    for mesh in [Mesh::default(), point] {
        let result = of_view(&[Drawn { mesh: &mesh, material: GREEN, thickness: 0.0 }], None, View::Front, 100);
        assert!(matches!(result, Err(PictureError::Empty)));
    }
}

#[test]
fn enormous_coordinates_still_give_a_picture() {
    let near = picture(&[(&ball(Vec3::ZERO, 1.0), GREEN)], View::Front);
    let mut mesh = ball(Vec3::ZERO, 1e38);
    let far = picture(&[(&mesh, GREEN)], View::Front);
    assert!(count(&far, is_green).abs_diff(count(&near, is_green)) < 20);
    // A vertex without a triangle does not change the frame.
    mesh.positions.push(Vec3::splat(3e38));
    mesh.normals.push(Vec3::Y);
    assert!(picture(&[(&mesh, GREEN)], View::Front) == far);
}

#[test]
fn what_lies_far_out_of_the_picture_takes_no_memory_and_shades_nothing() {
    let near = ball(Vec3::Y, 1.0);
    let stage = [Vec3::new(-1.2, 0.0, -1.2), Vec3::new(1.2, 2.0, 1.2)];
    let picture = |meshes: &[&Mesh]| {
        let drawn: Vec<_> = meshes.iter().map(|mesh| Drawn { mesh, material: GREEN, thickness: 0.0 }).collect();
        of_view(&drawn, Some(stage), View::Front, 100).expect("a finite scene has a picture")
    };
    let alone = picture(&[&near]);
    assert!(count(&alone, is_green) > 1000);
    for far in [1e3, 1e9, 1e30] {
        let both = picture(&[&near, &ball(Vec3::new(far, -far, 0.0), 1.0)]);
        // The cells of a shadow lie elsewhere, so its rim does by a cell.
        let difference: u32 = both.iter().zip(alone.iter()).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
        let mean = f64::from(difference) / both.len() as f64;
        assert!(mean < 1.0, "{far} m away: {mean} of 255");
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let [a, b] = [ball(Vec3::ZERO, 1.0), ball(Vec3::new(0.3, 0.9, 0.5), 0.6)];
    let scene = [(&a, GREEN), (&b, RED)];
    let first = picture(&scene, View::ThreeQuarter);
    for _ in 0..3 {
        assert!(picture(&scene, View::ThreeQuarter) == first);
    }
}

#[test]
fn neighbouring_triangles_leave_no_gap_and_share_no_cell() {
    // A fan around a point, its corners on cell centres, cell edges and between.
    let rim = [(640, 128), (1003, 300), (1152, 640), (1024, 1024), (640, 1152), (200, 1101), (128, 640), (256, 256)];
    let corner = |(x, y): (i32, i32)| Corner { x, y, height: 1.0 };
    for middle in [(640, 640), (650, 701), (512, 768), (896, 384)] {
        let mut plots = [[0; 6]; 6];
        for i in 0..rim.len() {
            let triangle = [middle, rim[i], rim[(i + 1) % rim.len()]].map(corner);
            let [a, b, c] = triangle;
            // Every second one turns the other way: facing must not matter.
            let triangle = if i % 2 == 0 { triangle } else { [a, c, b] };
            scan(triangle, 6, 0..6, |column, row, _| plots[row][column] += 1);
        }
        for (row, line) in plots.iter().enumerate() {
            for (column, plotted) in line.iter().enumerate() {
                assert!(*plotted <= 1, "cell {column}, {row} is plotted {plotted} times");
                let inner = (1..4).contains(&row) && (1..4).contains(&column);
                assert!(!inner || *plotted == 1, "cell {column}, {row} is a gap");
            }
        }
    }
}

#[test]
fn heights_are_those_of_the_plane() {
    let corner = |x: i32, y: i32| Corner { x: x * SUBPIXELS, y: y * SUBPIXELS, height: (2 * x + 5 * y) as f32 };
    let mut plots = 0;
    scan([corner(0, 0), corner(8, 0), corner(0, 8)], 8, 0..8, |column, row, height| {
        let plane = 2.0 * (column as f32 + 0.5) + 5.0 * (row as f32 + 0.5);
        assert!((height - plane).abs() < 1e-4, "{height} instead of {plane}");
        plots += 1;
    });
    // Half of 64 cells; each centre on the diagonal, which is a lower edge, belongs to the other half.
    assert_eq!(plots, 28);
}

#[test]
fn a_strip_shows_all_pictures_in_order() {
    let images = [(2, 3, 10), (4, 5, 20)].map(|(w, h, grey)| RgbImage::from_pixel(w, h, Rgb([grey; 3])));
    let strip = strip(&images);
    assert_eq!(strip.dimensions(), (6, 5));
    assert_eq!([(1, 2), (1, 3), (2, 4), (5, 0)].map(|(x, y)| strip.get_pixel(x, y)[0]), [10, 255, 20, 20]);
}

#[test]
fn a_file_appears_complete_or_not_at_all() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let image = RgbImage::from_fn(7, 5, |x, y| Rgb([x as u8, y as u8, 99]));
    let path = directory.path().join("front.png");
    save_png(&path, &image).expect("the directory exists");
    save_png(&path, &image).expect("an older picture is replaced");
    assert_eq!(image::open(&path).expect("it is a PNG").into_rgb8(), image);
    let files = std::fs::read_dir(directory.path()).expect("it is there").count();
    assert_eq!(files, 1);

    let missing = directory.path().join("nowhere").join("front.png");
    let error = save_png(&missing, &image).expect_err("there is no such directory");
    assert!(error.to_string().contains("nowhere"), "{error}");
}
