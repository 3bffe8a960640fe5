//! What is printed is read: the PDF of sheets as poppler draws it.

use sightline::detect::detect;
use sightline::detection::{Codes, DetectOptions, Target};
use sightline::ring_code::Family;
use sightline_report::sheets::{Ground, LEAST_PX, SheetOptions, Sheets, target_sheets};

use crate::support::extent;
use crate::support::painter::Uniform;
use crate::support::print_shot::{Print, Shot, Taken, drawn};

fn options_of(family: Family) -> DetectOptions {
    DetectOptions { codes: Codes::from(family), ..DetectOptions::default() }
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
            crate::support::data::count_as_skipped();
            return;
        };
        println!("{family:?} {dpi} dpi: places {place:.4} mm, diameters {diameter:.4} mm");
        assert!(place < 0.05 && diameter < 0.05, "{family:?}: {place} {diameter}");
    }
}

/// Every number of 8 px and more across its smaller axis, seen under at most 60°, is read, whatever blur, sharpening and noise. Of families
/// whose dots have spots none is read wrongly; sharpened spots of two pixels still cost some dots, which the bench counts.
#[test]
fn numbers_of_photographed_prints_are_right_and_their_centres_are_not_shifted() {
    let mut random = Uniform(20);
    let (mut asked, mut means) = (0, [const { Vec::<f64>::new() }; 2]);
    for (k, family) in Family::ALL.into_iter().enumerate() {
        let (ground, dpi) = ([Ground::Paper, Ground::Retro][k % 2], [300, 600][k / 2 % 2]);
        let options = SheetOptions { family, ground, codes: 60, diameter: 4.0, ..SheetOptions::default() };
        let sheets = target_sheets(&options).expect("sheets");
        let Some(greys) = drawn(&sheets.pdf(), dpi, sheets.pages.len(), &format!("shot-{family:?}")) else {
            println!("skipped, no poppler");
            crate::support::data::count_as_skipped();
            return;
        };
        let print = Print::new(&sheets, 0, greys.into_iter().next().expect("a page"), dpi);
        // `cargo xtask bench codes` takes 3000 photos
        for _ in 0..extent::cases(1, 3) {
            let taken = Taken::at_random(&mut random);
            let shot = Shot::new(&print, &taken);
            let targets = detect(&shot.view(), &options_of(family)).expect("targets").targets;
            let mut errors = [const { Vec::<f64>::new() }; 2];
            for seen in &shot.seen {
                let found = seen.found(&targets);
                let number = found.and_then(|target| target.code);
                assert!(number.is_none() || number == seen.number, "{family:?} {seen:?} {number:?} {taken:?}");
                let (small, steep) = (2.0 * seen.axes[1] < LEAST_PX, seen.incidence > 60f64.to_radians());
                if small || steep {
                    continue;
                }
                if family.design().spot() > 0.0 && number.is_none() {
                    continue;
                }
                asked += 1;
                assert_eq!((number, seen.others(&targets)), (seen.number, 0), "{family:?} {seen:?} {taken:?}");
                let target = found.expect("a target with a number");
                let error = [target.u - seen.centre[0], target.v - seen.centre[1]];
                let [du, dv] = seen.across;
                errors[0].push(error[0] * du + error[1] * dv);
                errors[1].push(error[1] * du - error[0] * dv);
            }
            for (means, errors) in means.iter_mut().zip(&errors).filter(|(_, errors)| !errors.is_empty()) {
                means.push(errors.iter().sum::<f64>() / errors.len() as f64);
            }
            let numbers = targets.iter().filter(|t| t.code.is_some());
            let elsewhere =
                numbers.filter(|t| shot.seen.iter().all(|seen| seen.found(std::slice::from_ref(*t)).is_none()));
            assert_eq!(elsewhere.count(), 0, "{family:?} {taken:?}");
        }
    }
    // the errors of a photo have its light in common: photos are what is independent
    for (means, axis) in means.iter().zip(["along the tilt", "across"]) {
        let n = means.len() as f64;
        let mean = means.iter().sum::<f64>() / n;
        let error = (means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (n - 1.0) / n).sqrt();
        println!("{asked} numbers, centres {axis}: {mean:.5} px, standard error {error:.5}");
        assert!(mean.abs() < 4.0 * error, "{axis}: {mean} {error}");
    }
    assert!(asked > extent::cases(160, 500), "{asked}");
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
