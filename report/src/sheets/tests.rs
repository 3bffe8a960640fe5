#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::drawing::Shape;
use super::*;
use sightline::ring_code::distance;

fn made(options: SheetOptions) -> Sheets {
    target_sheets(&options).expect("sheets")
}

fn refused(options: SheetOptions) -> Error {
    target_sheets(&options).expect_err("impossible")
}

#[test]
fn numbers_are_taken_as_they_are_written() {
    let sheets = made(SheetOptions { numbers: "3, 7-9;8 512".into(), ..SheetOptions::default() });
    let numbers: Vec<u32> = sheets.targets.iter().filter_map(|t| t.number).collect();
    assert_eq!(numbers, [3, 7, 8, 9, 512]);
}

#[test]
fn what_cannot_be_printed_is_named() {
    let field = |options| refused(options).place().field.expect("a field");
    assert_eq!(field(SheetOptions { numbers: "3-x".into(), ..SheetOptions::default() }), "numbers");
    assert_eq!(field(SheetOptions { numbers: "517".into(), ..SheetOptions::default() }), "numbers");
    assert_eq!(field(SheetOptions { codes: 517, ..SheetOptions::default() }), "codes");
    assert_eq!(field(SheetOptions { codes: 510, bars: 4, ..SheetOptions::default() }), "bars");
    assert_eq!(field(SheetOptions { diameter: 90.0, ..SheetOptions::default() }), "diameter");
    assert_eq!(field(SheetOptions { diameter: f64::NAN, ..SheetOptions::default() }), "diameter");
    assert_eq!(field(SheetOptions { measured: Some(10.0), ..SheetOptions::default() }), "measured");
    assert_eq!(field(SheetOptions { codes: 0, ..SheetOptions::default() }), "codes");
    assert_eq!(field(SheetOptions { codes: 0, dots: u32::MAX, ..SheetOptions::default() }), "dots");
    assert_eq!(field(SheetOptions { codes: 0, dots: 30_001, diameter: 2.0, ..SheetOptions::default() }), "dots");
    let plates = Some(Field { columns: 20, rows: 20 });
    assert_eq!(field(SheetOptions { codes: 0, field: plates, diameter: 2.0, ..SheetOptions::default() }), "field");
    assert_eq!(field(SheetOptions { bars: 1, bar_length: -1.0, ..SheetOptions::default() }), "bar_length");
}

#[test]
fn codes_offered_first_keep_their_distance() {
    let sheets = made(SheetOptions { codes: 8, ..SheetOptions::default() });
    let codes = Family::Ring14.codes();
    let numbers: Vec<u32> = sheets.targets.iter().filter_map(|t| t.number).collect();
    let mut least = u32::MAX;
    for (k, a) in numbers.iter().enumerate() {
        for b in &numbers[..k] {
            least = least.min(distance(codes[*a as usize - 1], codes[*b as usize - 1], 14));
        }
    }
    assert_eq!(sheets.least_distance, Some(least));
    assert!(least >= 4);
    let counts = counts(Family::Ring14);
    assert_eq!(counts.last().map(|c| (c.distance, c.count)), Some((2, 516)));
    assert!(counts.windows(2).all(|pair| pair[0].distance > pair[1].distance && pair[0].count < pair[1].count));
}

/// The drawn sectors, read back from their angles, are the code, its least significant bit first counter-clockwise from three o'clock: a
/// turned print is read the same, but it is not what its maker prints. A spot is where the design has one, and nothing but the target
/// stands in its clear ground.
#[test]
fn what_is_drawn_is_the_code_and_has_clear_ground() {
    for family in Family::ALL {
        for ground in [Ground::Paper, Ground::Retro] {
            let sheets =
                made(SheetOptions { family, ground, numbers: "1-40".into(), diameter: 6.0, ..SheetOptions::default() });
            let ring = family.design().ring().map(|r| r * 3.0);
            for target in &sheets.targets {
                let page = &sheets.pages[target.sheet - 1];
                let mut code = 0;
                let mut spots = Vec::new();
                for shape in &page.shapes {
                    let near = |at: &[f64; 2]| (at[0] - target.at[0]).hypot(at[1] - target.at[1]);
                    match shape {
                        Shape::Sector { at, radii, turns, .. } if near(at) < 1e-9 => {
                            assert_eq!(*radii, ring);
                            let n = family.bits();
                            let [from, to] = turns.map(|turn| (turn * f64::from(n)).round() as u32);
                            (from..to).for_each(|k| code |= 1 << (n - 1 - k % n));
                        }
                        // what covers the dot
                        Shape::Disc { at, radius, grey } if near(at) < 1e-9 && *radius < 3.0 => {
                            spots.push([*radius, *grey]);
                        }
                        Shape::Line { ends, .. } => {
                            assert!(ends.iter().all(|end| near(end) > ring[1] + CLEAR * 3.0 - 1e-9));
                        }
                        Shape::Text { at, size, .. } => {
                            assert!(
                                at[1] - size - target.at[1] > ring[1] + CLEAR * 3.0 - 1e-9
                                    || near(at) > ring[1] + CLEAR * 3.0
                            );
                        }
                        _ => {}
                    }
                }
                let number = target.number.expect("a code");
                assert_eq!(code, family.codes()[number as usize - 1], "{family:?} {code:b}");
                assert_eq!(code & 1, 1, "{family:?}: the first sector is set");
                let (spot, paper) = (family.design().spot(), f64::from(u8::from(ground == Ground::Paper)));
                assert_eq!(spots, if spot > 0.0 { vec![[spot * 3.0, paper]] } else { Vec::new() }, "{family:?}");
            }
        }
    }
}

#[test]
fn targets_lie_on_the_paper_and_apart() {
    for paper in [Paper::A4, Paper::A3, Paper::Letter] {
        let options = SheetOptions {
            paper,
            codes: 50,
            dots: 70,
            pattern: Pattern::Jittered,
            bars: 3,
            bar_length: 120.0,
            field: Some(Field { columns: 2, rows: 2 }),
            ..SheetOptions::default()
        };
        let sheets = made(options);
        let [width, height] = paper.size();
        for (k, a) in sheets.targets.iter().enumerate() {
            let half = if a.number.is_some() { 20.0 } else { 10.0 };
            assert!(a.at[0] > half + 4.0 && a.at[0] < width - half - 10.0, "{a:?}");
            assert!(a.at[1] > half + 15.0 && a.at[1] < height - half - 18.0, "{a:?}");
            for b in sheets.targets[..k].iter().filter(|b| b.sheet == a.sheet) {
                assert!((a.at[0] - b.at[0]).hypot(a.at[1] - b.at[1]) > 19.9, "{a:?} {b:?}");
            }
        }
        let mut ids: Vec<&String> = sheets.targets.iter().map(|t| &t.id).collect();
        ids.sort();
        ids.dedup();
        assert_eq!(ids.len(), sheets.targets.len());
    }
}

#[test]
fn the_scale_of_the_print_goes_into_what_is_told() {
    let options = SheetOptions {
        codes: 2,
        bars: 1,
        bar_length: 120.0,
        field: Some(Field { columns: 2, rows: 1 }),
        measured: Some(99.0),
        measured_down: Some(98.0),
        ..SheetOptions::default()
    };
    let sheets = made(options);
    assert!((sheets.diameter - 9.85).abs() < 1e-9);
    assert!((sheets.bars[0].length - 120.0 * 0.99).abs() < 1e-9);
    let plate: Vec<&Printed> = sheets.targets.iter().filter(|t| t.plate.is_some()).collect();
    let (a, b) = (plate[0], plate[1]);
    let apart = b.plate.expect("a place")[0] - a.plate.expect("a place")[0];
    assert!((apart - (b.at[0] - a.at[0]) * 0.99).abs() < 1e-9);
    let files = sheets.files();
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["targets.csv", "distances.csv", "control.csv"]);
    let table = sightline_exchange::control_csv::parse(std::str::from_utf8(&files[2].1).expect("text"));
    let points = table.into_points().expect("points");
    assert_eq!(points.len(), plate.len());
    assert!(points.iter().all(|point| point.diameter == Some(9.85)));
    assert!(String::from_utf8_lossy(&files[0].1).contains("9.8500"));
}

/// A bar longer than the sheet is cut out end by end, and its length is left to be measured.
#[test]
fn long_bars_are_mounted_by_hand() {
    let sheets =
        made(SheetOptions { codes: 0, bars: 2, bar_length: 1800.0, measured: Some(99.0), ..SheetOptions::default() });
    assert_eq!(sheets.targets.len(), 4);
    assert!(sheets.bars.iter().all(|bar| bar.length == 1800.0 && bar.sigma.is_none()));
}

#[test]
fn a_pdf_has_a_page_a_sheet_and_asks_for_no_scaling() {
    let sheets = made(SheetOptions { codes: 45, title: "탱크 Tank (2)".into(), ..SheetOptions::default() });
    let pdf = sheets.pdf();
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.starts_with("%PDF-") && text.contains("/PrintScaling /None"));
    assert_eq!(text.matches("/MediaBox").count(), sheets.pages.len());
    assert!(sheets.svg(0).expect("a page").contains("viewBox=\"0 0 210 297\""));
    assert!(sheets.svg(sheets.pages.len()).is_none());
}

#[test]
fn diameters_follow_distance_and_angle() {
    let options = AdviceOptions {
        c_px: 5000.0,
        distances: vec![1000.0, 4000.0],
        angles: vec![0.0, 60f64.to_radians()],
        diameter: 10.0,
    };
    let rows = advice(&options).expect("a table");
    assert!((rows[0].pixel - 0.2).abs() < 1e-12 && (rows[0].least[0] - 1.6).abs() < 1e-12);
    assert!((rows[1].best[1] - 24.0).abs() < 1e-9 && (rows[1].pixels[1] - 6.25).abs() < 1e-9);
    assert!(advice(&AdviceOptions { c_px: 0.0, ..options }).is_err());
}
