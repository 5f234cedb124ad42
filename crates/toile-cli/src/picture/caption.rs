//! Words on pictures: small letters, digits and a few signs, five pixels wide and seven high, drawn larger.

use image::{Rgb, RgbImage};

/// Pixels of a picture for one of a letter.
const SCALE: u32 = 2;
/// Space on the left and above [px].
const MARGIN: u32 = 12;
/// Width of a letter and the space after it.
const STEP: u32 = 6;
/// Height of a letter and the space below it.
const LINE: u32 = 10;
const INK: Rgb<u8> = Rgb([40, 40, 40]);

/// The letters, each in rows from above; the leftmost pixel is the highest of five bits.
const LETTERS: [(char, [u8; 7]); 39] = [
    ('a', [0, 0, 14, 1, 15, 17, 15]),
    ('b', [16, 16, 30, 17, 17, 17, 30]),
    ('c', [0, 0, 14, 16, 16, 17, 14]),
    ('d', [1, 1, 15, 17, 17, 17, 15]),
    ('e', [0, 0, 14, 17, 31, 16, 14]),
    ('f', [6, 8, 28, 8, 8, 8, 8]),
    ('g', [0, 0, 15, 17, 15, 1, 14]),
    ('h', [16, 16, 30, 17, 17, 17, 17]),
    ('i', [4, 0, 12, 4, 4, 4, 14]),
    ('j', [2, 0, 6, 2, 2, 18, 12]),
    ('k', [16, 16, 18, 20, 24, 20, 18]),
    ('l', [12, 4, 4, 4, 4, 4, 14]),
    ('m', [0, 0, 26, 21, 21, 17, 17]),
    ('n', [0, 0, 30, 17, 17, 17, 17]),
    ('o', [0, 0, 14, 17, 17, 17, 14]),
    ('p', [0, 0, 30, 17, 30, 16, 16]),
    ('q', [0, 0, 15, 17, 15, 1, 1]),
    ('r', [0, 0, 22, 25, 16, 16, 16]),
    ('s', [0, 0, 15, 16, 14, 1, 30]),
    ('t', [8, 8, 28, 8, 8, 9, 6]),
    ('u', [0, 0, 17, 17, 17, 19, 13]),
    ('v', [0, 0, 17, 17, 17, 10, 4]),
    ('w', [0, 0, 17, 17, 21, 21, 10]),
    ('x', [0, 0, 17, 10, 4, 10, 17]),
    ('y', [0, 0, 17, 17, 15, 1, 14]),
    ('z', [0, 0, 31, 2, 4, 8, 31]),
    ('0', [14, 17, 19, 21, 25, 17, 14]),
    ('1', [4, 12, 4, 4, 4, 4, 14]),
    ('2', [14, 17, 1, 6, 8, 16, 31]),
    ('3', [14, 17, 1, 6, 1, 17, 14]),
    ('4', [2, 6, 10, 18, 31, 2, 2]),
    ('5', [31, 16, 30, 1, 1, 17, 14]),
    ('6', [6, 8, 16, 30, 17, 17, 14]),
    ('7', [31, 1, 2, 4, 8, 8, 8]),
    ('8', [14, 17, 17, 14, 17, 17, 14]),
    ('9', [14, 17, 17, 15, 1, 2, 12]),
    ('%', [24, 25, 2, 4, 8, 19, 3]),
    ('.', [0, 0, 0, 0, 0, 12, 12]),
    ('-', [0, 0, 0, 14, 0, 0, 0]),
];

/// Writes lines into the upper left corner of a picture. A sign that is no letter of these stays empty.
pub fn caption(picture: &mut RgbImage, lines: &[&str]) {
    for (row, line) in lines.iter().enumerate() {
        for (column, sign) in line.chars().enumerate() {
            let Some((_, rows)) = LETTERS.iter().find(|(letter, _)| *letter == sign) else { continue };
            let corner = [column as u32 * STEP, row as u32 * LINE].map(|place| MARGIN + SCALE * place);
            letter(picture, corner, rows);
        }
    }
}

fn letter(picture: &mut RgbImage, [left, top]: [u32; 2], rows: &[u8; 7]) {
    for (y, bits) in (0..).zip(rows) {
        for x in (0..5).filter(|x| bits & (16 >> x) != 0) {
            for (dx, dy) in (0..SCALE).flat_map(|dx| (0..SCALE).map(move |dy| (dx, dy))) {
                if let Some(pixel) = picture.get_pixel_mut_checked(left + SCALE * x + dx, top + SCALE * y + dy) {
                    *pixel = INK;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_in_the_corner_and_end_at_the_edge() {
        let mut picture = RgbImage::from_pixel(60, 40, Rgb([255; 3]));
        caption(&mut picture, &["il", "a word that is wider than its picture"]);
        let ink = |x: u32, y: u32| *picture.get_pixel(x, y) == INK;
        let column = |x: u32| (MARGIN..MARGIN + SCALE * 7).filter(|y| ink(x, *y)).count() as u32;
        // The stem of the i, which lacks its second row of seven, and that of the l.
        assert_eq!([MARGIN + 2 * SCALE, MARGIN + (STEP + 2) * SCALE].map(column), [6 * SCALE, 7 * SCALE]);
        assert!((0..MARGIN).all(|x| (0..40).all(|y| !ink(x, y))));
    }

    #[test]
    fn every_letter_is_there_once() {
        let mut signs: Vec<char> = LETTERS.iter().map(|(sign, _)| *sign).collect();
        signs.sort_unstable();
        signs.dedup();
        assert_eq!(signs.len(), LETTERS.len());
        assert!(LETTERS.iter().all(|(_, rows)| rows.iter().all(|bits| *bits < 32)));
    }
}
