//! Ring codes read from pictures drawn at random (`tests/engine/support/coded_patch.rs`): how many are read, how many wrongly.
//!
//!   cargo bench --package sightline --bench codes -- [pictures] [seed] [kind] [camera]
//!   cargo bench --package sightline --bench codes -- state STATE KIND FAMILY [FILE]
//!
//! With `camera` levels follow light as in the pictures that cameras make. The second draws one picture again that the first has told
//! of, and writes it as a PGM.

use std::collections::BTreeMap;
use std::time::Instant;

use sightline::detect::{detect, read_codes};
use sightline::detection::{Codes, DetectOptions, Target};
use sightline::ring_code::Family;

#[allow(dead_code, reason = "shared with the tests, which use all of it")]
#[path = "../../tests/engine/support/coded_patch.rs"]
mod coded_patch;
#[path = "../../tests/engine/support/painter.rs"]
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
mod painter;

use coded_patch::{CodedPatch, Curve, Kind, coded_patch};
use painter::Uniform;

/// Number of pictures between progress messages.
const PROGRESS: u64 = 2000;

/// Dots from this diameter on are asked to be read.
const LEGIBLE: f64 = 12.0;

#[derive(Clone, Copy, Default)]
struct Tally {
    pictures: usize,
    found: usize,
    read: usize,
    doubtful: usize,
    wrong: usize,
    /// Of dots that are large enough: pictures, detected, read of these, read when those that were not found are given.
    large: [usize; 4],
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.pictures += other.pictures;
        self.found += other.found;
        self.read += other.read;
        self.doubtful += other.doubtful;
        self.wrong += other.wrong;
        self.large.iter_mut().zip(other.large).for_each(|(sum, more)| *sum += more);
    }
}

fn main() {
    let mut words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let curve = if words.iter().any(|word| word == "camera") { Curve::Camera } else { Curve::Flat };
    words.retain(|word| word != "camera");
    if words.first().is_some_and(|word| word == "state") {
        return again(&words[1..], curve);
    }
    let number = |k: usize, otherwise: u64| words.get(k).and_then(|word| word.parse().ok()).unwrap_or(otherwise);
    let (pictures, seed) = (number(0, 200_000), number(1, 1));
    let only = words.get(2).cloned();
    let began = Instant::now();
    let mut random = Uniform(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mut by_kind: BTreeMap<Kind, Tally> = BTreeMap::new();
    let mut by_family: BTreeMap<Family, Tally> = BTreeMap::new();
    let mut shown = 0;
    let mut spent = 0.0;
    for k in 0..pictures {
        // half of the pictures are codes
        let kind = if k % 2 == 0 { Kind::Code } else { Kind::ALL[1 + (k / 2) as usize % (Kind::ALL.len() - 1)] };
        let family = Family::ALL[(random.next() * 8.0) as usize % 8];
        let before = random.0;
        let patch = coded_patch(kind, family, curve, &mut random);
        if k > 0 && k % PROGRESS == 0 {
            let sum = |of: fn(&Tally) -> usize| by_kind.values().map(of).sum::<usize>();
            println!(
                "{k} pictures, {} read, {} wrong, {:.0} s",
                sum(|t| t.read),
                sum(|t| t.wrong),
                began.elapsed().as_secs_f64()
            );
        }
        if only.as_ref().is_some_and(|only| format!("{kind:?}") != *only) {
            continue;
        }
        let start = Instant::now();
        let (tally, note) = judge(&patch);
        spent += start.elapsed().as_secs_f64();
        by_kind.entry(kind).or_default().add(&tally);
        if kind == Kind::Code {
            by_family.entry(family).or_default().add(&tally);
        }
        let unread = tally.large[0] > 0 && kind == Kind::Code && tally.large[3] == 0;
        // however many are not read: every wrong one is printed
        if tally.wrong > 0 || unread && shown < 60 {
            shown += usize::from(tally.wrong == 0);
            println!(
                "{} {kind:?} {family:?} state {before}: {note}; dot {:.1} px, tilt {:.0}, sector {:.2} px, blur {:.2}, contrast {:.0}, sharpened {:.2}",
                if tally.wrong > 0 { "WRONG" } else { "unread" },
                patch.diameter,
                patch.tilt.to_degrees(),
                patch.sector,
                patch.blur,
                patch.contrast,
                patch.sharpening
            );
        }
    }
    table("kind", by_kind.iter().map(|(kind, tally)| (format!("{kind:?}"), *tally)));
    table("family", by_family.iter().map(|(family, tally)| (format!("{family:?}"), *tally)));
    println!("{:.0} s, of which {spent:.0} s in the engine", began.elapsed().as_secs_f64());
}

/// One picture again, with all that is found in it.
fn again(words: &[String], curve: Curve) {
    let [state, kind, family, file @ ..] = words else { panic!("state STATE KIND FAMILY [FILE]") };
    let kind = Kind::ALL.into_iter().find(|one| format!("{one:?}") == *kind).expect("a kind");
    let family = Family::ALL.into_iter().find(|one| format!("{one:?}") == *family).expect("a family");
    let patch = coded_patch(kind, family, curve, &mut Uniform(state.parse().expect("a number")));
    let options = DetectOptions { codes: Codes::from(family), ..DetectOptions::default() };
    println!("dot at {:.2} {:.2}, axes {:.2?}", patch.u, patch.v, patch.axes);
    for target in detect(&patch.view(), &options).expect("valid options").targets {
        println!("{target:#?}");
    }
    println!("{}", judge(&patch).1);
    if let [file] = file {
        let mut bytes = format!("P5 {} {} 255\n", patch.size, patch.size).into_bytes();
        bytes.extend(&patch.samples);
        std::fs::write(file, bytes).expect("the file is written");
    }
}

fn table(heading: &str, rows: impl Iterator<Item = (String, Tally)>) {
    println!(
        "\n{heading:>12} {:>9} {:>9} {:>9} {:>9} {:>6} | from {LEGIBLE} px: {:>9} {:>9} {:>8} {:>8}",
        "pictures", "found", "read", "doubtful", "wrong", "pictures", "found", "read %", "given %"
    );
    let percent = |part: usize, whole: usize| 100.0 * part as f64 / whole.max(1) as f64;
    for (name, t) in rows {
        let [pictures, found, read, given] = t.large;
        println!(
            "{name:>12} {:>9} {:>9} {:>9} {:>9} {:>6} | {pictures:>20} {found:>9} {:>8.2} {:>8.2}",
            t.pictures,
            t.found,
            t.read,
            t.doubtful,
            t.wrong,
            percent(read, found),
            percent(given, pictures)
        );
    }
}

/// Results of detection and of the code reader alone for a picture.
fn judge(patch: &CodedPatch) -> (Tally, String) {
    let codes = Codes::from(patch.family);
    let view = patch.view();
    let options = DetectOptions { codes, ..DetectOptions::default() };
    let found = detect(&view, &options).expect("valid options").targets;
    let at_dot = |t: &&Target| (t.u - patch.u).hypot(t.v - patch.v) < 1.5 && t.major > 0.6 * patch.diameter;
    let dot = found.iter().find(at_dot).cloned();
    // the reader alone, where detection does not find the dot
    let mut given = [dot.clone().unwrap_or_else(|| patch.dot())];
    if dot.is_none() {
        read_codes(&view, &mut given, codes);
    }
    let [given] = given;
    let right = |t: &Target| t.code.is_some() && t.code == patch.number;
    let wrong_one = |t: &Target| t.code.is_some() && (t.code != patch.number || !at_dot(&t));
    let mut tally = Tally { pictures: 1, ..Tally::default() };
    tally.found = usize::from(dot.is_some());
    tally.read = usize::from(dot.as_ref().is_some_and(right));
    tally.doubtful = usize::from(dot.as_ref().is_some_and(|t| !t.code_candidates.is_empty()));
    tally.wrong = found.iter().filter(|t| wrong_one(t)).count() + usize::from(dot.is_none() && wrong_one(&given));
    if patch.diameter >= LEGIBLE {
        tally.large = [1, tally.found, tally.read, usize::from(right(&given))];
    }
    let numbers: Vec<u32> = found.iter().filter_map(|t| t.code).collect();
    let note = format!(
        "{:?}, found {numbers:?}, given {:?} {:?} {:?} {:?}",
        patch.number,
        given.code,
        given.quality.code_margin,
        given.quality.code_note,
        given.code_candidates.len()
    );
    (tally, note)
}
