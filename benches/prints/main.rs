//! Printed sheets photographed (`tests/engine/support/print_shot.rs`): how many numbers are read rightly, wrongly or not, and whether centres
//! are biased along the tilt or across it. It takes poppler's `pdftoppm`.
//!
//!   cargo bench --package sightline --bench prints -- [photos of each print] [seed] [family, as "ring-14"]
//!
//! Asked is every number of at least 8 px across its dot's smaller axis, which is what the advice of the sheets counts, under at
//! most 60° between the ray and the sheet's normal.

use std::collections::BTreeMap;
use std::time::Instant;

use sightline::detect::detect;
use sightline::detection::{DetectOptions, Detection, Target};
use sightline::ring_code::Family;
use sightline_report::sheets::{Ground, LEAST_PX, SheetOptions, target_sheets};

#[allow(dead_code, reason = "shared with the tests, which use all of it")]
#[path = "../../tests/engine/support/coded_patch.rs"]
mod coded_patch;
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
#[path = "../../tests/engine/support/painter.rs"]
mod painter;
#[path = "../../tests/engine/support/print_shot.rs"]
mod print_shot;

use painter::Uniform;
use print_shot::{Print, Seen, Shot, Taken, drawn};

/// Diameter of the dots on the sheets, mm: some sixty to eighty codes a sheet.
const DIAMETER: f64 = 4.0;
/// Sheets of each family, ground and resolution; their numbers are spread over the family.
const SHEETS: usize = 2;

/// Results for code numbers, and the errors of their centres along the minor axis and across.
#[derive(Clone, Copy, Default)]
struct Tally {
    asked: usize,
    right: usize,
    wrong: usize,
    unread: usize,
    missing: usize,
    /// Targets in the dots beside the dots themselves.
    others: usize,
    /// Along the smaller axis and across: sums of the errors in pixels, and of the squares of them over their standard errors.
    errors: [f64; 2],
    shares: [f64; 2],
    /// Over photos: squared number of errors; and for each axis the square of their sum, and that sum times their number.
    photos: [f64; 5],
}

impl Tally {
    fn add(&mut self, one: &Self) {
        self.asked += one.asked;
        self.right += one.right;
        self.wrong += one.wrong;
        self.unread += one.unread;
        self.missing += one.missing;
        self.others += one.others;
        let sums = self.errors.iter_mut().chain(&mut self.shares).chain(&mut self.photos);
        sums.zip(one.errors.iter().chain(&one.shares).chain(&one.photos)).for_each(|(sum, more)| *sum += more);
    }

    /// Ends a photo, whose errors have light and lens in common.
    fn end_photo(mut self) -> Self {
        let (n, [a, b]) = (self.measured(), self.errors);
        self.photos = [n * n, a * a, b * b, a * n, b * n];
        self
    }

    fn measured(&self) -> f64 {
        (self.right + self.unread) as f64
    }

    /// Mean error along an axis in pixels, the same over its standard error, and the rms of errors over what they were told to be. What
    /// the errors of a photo have in common is in that standard error: it is that of the sums over photos.
    fn bias(&self, axis: usize) -> [f64; 3] {
        let n = self.measured().max(1.0);
        let mean = self.errors[axis] / n;
        let [nn, squares, products] = [self.photos[0], self.photos[1 + axis], self.photos[3 + axis]];
        let spread = (squares - 2.0 * mean * products + mean * mean * nn).max(1e-18).sqrt() / n;
        [mean, mean / spread, (self.shares[axis] / n).sqrt()]
    }
}

#[derive(Default)]
struct Tables(BTreeMap<(&'static str, String), Tally>);

impl Tables {
    fn add(&mut self, table: &'static str, row: impl Into<String>, tally: &Tally) {
        self.0.entry((table, row.into())).or_default().add(tally);
    }

    /// Takes in what a photo gave.
    fn add_photo(&mut self, photo: Self) {
        for ((table, row), tally) in photo.0 {
            self.add(table, row, &tally.end_photo());
        }
    }

    fn print(&self) {
        let mut last = "";
        for ((table, row), t) in &self.0 {
            if *table != last {
                println!(
                    "\n{table:>18} {:>8} {:>8} {:>6} {:>6} {:>7} {:>6} {:>9} | {:>9} {:>6} {:>5} | {:>9} {:>6} {:>5}",
                    "numbers",
                    "right",
                    "wrong",
                    "unread",
                    "missing",
                    "others",
                    "right %",
                    "along px",
                    "z",
                    "rms/s",
                    "across px",
                    "z",
                    "rms/s"
                );
                last = table;
            }
            let ([a, az, ar], [b, bz, br]) = (t.bias(0), t.bias(1));
            println!(
                "{row:>18} {:>8} {:>8} {:>6} {:>6} {:>7} {:>6} {:>9.3} | {a:>9.5} {az:>6.2} {ar:>5.2} | {b:>9.5} {bz:>6.2} {br:>5.2}",
                t.asked,
                t.right,
                t.wrong,
                t.unread,
                t.missing,
                t.others,
                100.0 * t.right as f64 / t.asked.max(1) as f64
            );
        }
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let number = |k: usize, otherwise: u64| words.get(k).and_then(|word| word.parse().ok()).unwrap_or(otherwise);
    let (photos, seed) = (number(0, 12), number(1, 1));
    let began = Instant::now();
    let mut random = Uniform(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let (mut tables, mut spent) = (Tables::default(), 0.0);
    for family in Family::ALL.into_iter().filter(|family| words.get(2).is_none_or(|only| *only == name(*family))) {
        for (ground, dpi) in [(Ground::Paper, 300), (Ground::Paper, 600), (Ground::Retro, 300), (Ground::Retro, 600)] {
            for print in &prints(family, ground, dpi, &mut random) {
                for _ in 0..photos {
                    let taken = Taken::at_random(&mut random);
                    let shot = Shot::new(print, &taken);
                    let start = Instant::now();
                    let options = DetectOptions { codes: family.into(), ..DetectOptions::default() };
                    let found = detect(&shot.view(), &options).expect("valid options");
                    spent += start.elapsed().as_secs_f64();
                    tables.add_photo(looked_at(&shot, &found, &taken, &format!("{} {ground:?} {dpi}", name(family))));
                }
            }
        }
    }
    tables.print();
    println!("{:.0} s, of which {spent:.0} s in the engine", began.elapsed().as_secs_f64());
}

/// The family's name on the border.
fn name(family: Family) -> String {
    serde_json::to_string(&family).expect("a name").trim_matches('"').to_owned()
}

/// Results for every code number of a photo. A code that was not read is printed with all that is needed to draw it again.
fn looked_at(shot: &Shot, found: &Detection, taken: &Taken, print: &str) -> Tables {
    let targets = &found.targets;
    let mut photo = Tables::default();
    for seen in &shot.seen {
        let (tally, what) = judge(seen, targets);
        let (small, steep) = (2.0 * seen.axes[1] < LEAST_PX, seen.incidence > 60f64.to_radians());
        if small || steep {
            photo.add("0 all", if small { "smaller" } else { "steeper" }, &tally);
            continue;
        }
        if tally.right == 0 || tally.others > 0 {
            let ([u, v], [a, b]) = (seen.centre, seen.axes.map(|axis| 2.0 * axis));
            let degrees = seen.incidence.to_degrees();
            let why: Vec<_> = (found.rejected_blobs.iter())
                .filter(|blob| (blob.u - u).hypot(blob.v - v) < 0.5 * b)
                .map(|blob| (blob.reason, (10.0 * blob.diameter).round() / 10.0))
                .collect();
            let note = seen.found(targets).and_then(|target| target.quality.code_note);
            println!(
                "{what} {print} at {u:.1} {v:.1}: {a:.1} x {b:.1} px, {degrees:.0} deg, {why:?} {note:?}, {taken:.2?}"
            );
        }
        let from = |x: f64, by: f64| format!("{:04.1}..", (x / by).floor() * by);
        photo.add("0 all", "asked", &tally);
        photo.add("1 tilt", from(seen.incidence.to_degrees(), 10.0), &tally);
        photo.add("2 minor px", from((2.0 * seen.axes[1]).min(24.0), 2.0), &tally);
        photo.add(
            "3 sharpened",
            if taken.sharpening > 0.0 { from(taken.sharpening, 0.3) } else { "no".into() },
            &tally,
        );
        photo.add("4 blur", from(taken.blur, 0.3), &tally);
        photo.add("5 print", print, &tally);
    }
    let beside =
        |t: &&Target| t.code.is_some() && shot.seen.iter().all(|seen| seen.found(std::slice::from_ref(*t)).is_none());
    let wrong = targets.iter().filter(beside).count();
    if wrong > 0 {
        println!("WRONG {print}: {wrong} numbers where none are, {taken:.2?}");
        photo.add("0 all", "where none are", &Tally { asked: wrong, wrong, ..Tally::default() });
    }
    photo
}

/// Sheets of one family, their numbers drawn at random.
fn prints(family: Family, ground: Ground, dpi: u32, random: &mut Uniform) -> Vec<Print> {
    let all = family.codes().len();
    let numbers: Vec<String> =
        (0..400).map(|_| ((random.next() * all as f64) as usize % all + 1).to_string()).collect();
    let options =
        SheetOptions { family, ground, numbers: numbers.join(" "), diameter: DIAMETER, ..SheetOptions::default() };
    let sheets = target_sheets(&options).expect("sheets");
    let kind = format!("prints-{family:?}-{ground:?}-{dpi}");
    let greys = drawn(&sheets.pdf(), dpi, sheets.pages.len(), &kind).expect("pdftoppm, of poppler-utils");
    greys.into_iter().take(SHEETS).enumerate().map(|(k, grey)| Print::new(&sheets, k, grey, dpi)).collect()
}

fn judge(seen: &Seen, targets: &[Target]) -> (Tally, &'static str) {
    let mut tally = Tally { asked: 1, others: seen.others(targets), ..Tally::default() };
    let Some(target) = seen.found(targets) else {
        tally.missing = 1;
        return (tally, "missing");
    };
    let what = match target.code {
        Some(_) if target.code == seen.number => {
            tally.right = 1;
            "right"
        }
        Some(_) => {
            tally.wrong = 1;
            return (tally, "WRONG");
        }
        None => {
            tally.unread = 1;
            "unread"
        }
    };
    let error = [target.u - seen.centre[0], target.v - seen.centre[1]];
    // along the slope, away from the camera, and across
    let [s, c] = seen.across;
    for (k, [du, dv]) in [[s, c], [-c, s]].into_iter().enumerate() {
        let e = error[0] * du + error[1] * dv;
        let variance =
            du * du * target.sigma_u.powi(2) + dv * dv * target.sigma_v.powi(2) + 2.0 * du * dv * target.covariance_uv;
        tally.errors[k] = e;
        tally.shares[k] = e * e / variance;
    }
    (tally, what)
}
