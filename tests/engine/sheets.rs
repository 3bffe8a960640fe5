//! What is printed is read: the PDF of sheets as poppler draws it.

use std::process::Command;

use sightline::detect::detect;
use sightline::detection::{Codes, DetectOptions, Target};
use sightline::image::Grey;
use sightline::image::Samples;
use sightline::ring_code::Family;
use sightline::sheets::{Ground, SheetOptions, Sheets, target_sheets};

fn options_of(family: Family) -> DetectOptions {
    DetectOptions { codes: Codes::from(family), ..DetectOptions::default() }
}

/// The PDF's pages as poppler draws them at a resolution; none where poppler is not there.
fn drawn(pdf: &[u8], dpi: u32, pages: usize, name: &str) -> Option<Vec<Grey>> {
    let folder = std::env::temp_dir().join(format!("sightline-sheets-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("sheets.pdf");
    std::fs::write(&file, pdf).expect("written");
    let ran = Command::new("pdftoppm")
        .args(["-gray", "-r", &dpi.to_string()])
        .args([file.as_os_str(), folder.join("page").as_os_str()])
        .status();
    let read = |k: usize| {
        let digits = pages.to_string().len();
        let bytes = std::fs::read(folder.join(format!("page-{k:0digits$}.pgm"))).expect("a page");
        pgm(&bytes)
    };
    let greys = ran.ok().map(|status| {
        assert!(status.success());
        (1..=pages).map(read).collect()
    });
    std::fs::remove_dir_all(&folder).expect("removed");
    greys
}

fn pgm(bytes: &[u8]) -> Grey {
    let mut fields = Vec::new();
    let mut at = 0;
    while fields.len() < 4 {
        let end = at + bytes[at..].iter().position(u8::is_ascii_whitespace).expect("a field");
        fields.push(String::from_utf8_lossy(&bytes[at..end]).into_owned());
        at = end + 1;
    }
    let [width, height] = [1, 2].map(|k: usize| fields[k].parse().expect("a number"));
    Grey { width, height, samples: Samples::U8(bytes[at..at + width * height].to_vec()) }
}

/// The largest difference between a target's place in the PDF and where it was to be, and whether all numbers are right.
fn measured(sheets: &Sheets, family: Family, dpi: u32, name: &str) -> Option<(f64, f64)> {
    let pixel = 25.4 / f64::from(dpi);
    let greys = drawn(&sheets.pdf(), dpi, sheets.pages.len(), name)?;
    let (mut worst, mut diameter) = (0.0_f64, 0.0_f64);
    for (k, grey) in greys.iter().enumerate() {
        let targets = detect(&grey.view().expect("a page"), &options_of(family)).expect("targets").targets;
        for printed in sheets.targets.iter().filter(|t| t.sheet == k + 1) {
            let at = printed.at.map(|x| x / pixel);
            let distance = |t: &&Target| (t.u - at[0]).hypot(t.v - at[1]);
            let target = targets.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("a target");
            worst = worst.max(distance(&target) * pixel);
            diameter = diameter.max((0.5 * (target.major + target.minor) * pixel - sheets.diameter).abs());
            assert_eq!(target.code_in(family), printed.number, "{family:?} {name} sheet {}", k + 1);
        }
    }
    Some((worst, diameter))
}

#[test]
fn the_pdf_is_true_to_scale_and_its_numbers_are_right() {
    for (family, ground, dpi) in [
        (Family::Ring12, Ground::Paper, 300),
        (Family::Ring20, Ground::Retro, 300),
        (Family::Metashape16, Ground::Paper, 300),
        (Family::Ring14, Ground::Paper, 600),
    ] {
        let options = SheetOptions { family, ground, codes: 12, diameter: 8.0, ..SheetOptions::default() };
        let options =
            if dpi == 600 { SheetOptions { codes: 0, bars: 2, bar_length: 120.0, ..options } } else { options };
        let sheets = target_sheets(&options).expect("sheets");
        let Some((place, diameter)) = measured(&sheets, family, dpi, &format!("{family:?}-{dpi}")) else {
            println!("skipped, no poppler");
            super::data::count_as_skipped();
            return;
        };
        println!("{family:?} {dpi} dpi: places {place:.4} mm, diameters {diameter:.4} mm");
        assert!(place < 0.05 && diameter < 0.05, "{family:?}: {place} {diameter}");
    }
}

/// Every number of every family, printed and read back: 53,000 codes, minutes. `cargo test -p sightline --test engine -- --ignored every_number`
#[test]
#[ignore = "53,000 codes take minutes"]
fn every_number_of_every_family_is_read_from_the_pdf() {
    for family in Family::ALL {
        let all = family.codes().len() as u32;
        let mut first = 1;
        while first <= all {
            let last = (first + 1199).min(all);
            let numbers = format!("{first}-{last}");
            let options = SheetOptions {
                family,
                numbers,
                diameter: 2.0,
                cut_marks: false,
                labels: false,
                ..SheetOptions::default()
            };
            let sheets = target_sheets(&options).expect("sheets");
            let Some((place, _)) = measured(&sheets, family, 300, &format!("all-{family:?}-{first}")) else { return };
            println!("{family:?} {first}-{last}: all right, places {place:.4} mm");
            first = last + 1;
        }
    }
}
