//! Ring codes whose arcs all end on a coarser grid: codes of 8 and 10 sectors are no codes of 16 and 20.

use super::codes::{Look, Plate, laid_out, painted, plate_of, read};
use crate::support::data::data;
use crate::support::extent;
use crate::support::painter::Uniform;
use sightline::decode;
use sightline::detect::detect_photo;
use sightline::detection::{CodeNote, Codes, DetectOptions, Detection};
use sightline::ring_code::{Family, coarser_grid, smallest_rotation};

fn look(random: &mut Uniform) -> Look {
    Look { radii: [8.0, 14.0], blur: random.within(0.6, 0.9), dark: random.next() < 0.5, even: true }
}

/// A plate of rings of half the family's sectors, drawn as pairs of these: all there are, codes or not.
fn halved(family: Family, random: &mut Uniform, seed: u64) -> Plate {
    let (bits, look) = (family.bits(), look(random));
    let mut coded = laid_out(family, family.codes(), &look, random);
    for target in &mut coded {
        // neither none nor all set
        let half = 1 + (random.next() * f64::from((1u32 << (bits / 2)) - 2)) as u32;
        let pairs = (0..bits).fold(0u32, |pairs, k| pairs | (half >> (k / 2) & 1) << k);
        target.code = smallest_rotation(pairs, bits);
    }
    painted(coded, &look, seed, |target, x, y| target.is_marked(x, y, family))
}

fn is_coarse(family: Family, code: u32) -> bool {
    coarser_grid(code, family.bits()).is_some()
}

#[test]
fn rings_of_half_the_sectors_have_no_number() {
    let mut random = Uniform(8);
    let families = [Family::Ring16, Family::Ring20, Family::Metashape16, Family::Metashape20];
    for (seed, &family) in extent::of(&families, 2).iter().enumerate() {
        let plate = halved(family, &mut random, seed as u64);
        for codes in [Codes::Auto, family.into()] {
            let found = read(&plate, codes);
            let numbers: Vec<_> = found.targets.iter().filter_map(|t| t.code).collect();
            assert!(numbers.is_empty(), "{family:?}, {codes:?}: {numbers:?}");
            let told = found.targets.iter().filter(|t| t.quality.code_note == Some(CodeNote::OtherFamily)).count();
            // candidates too, where the family has the code
            let asked = found.targets.iter().filter(|t| !t.code_candidates.is_empty()).count();
            println!("{family:?}, {codes:?}: {told} of {} told, {asked} with candidates", plate.coded.len());
            assert!(2 * told > plate.coded.len() && asked > 0, "{family:?}, {codes:?}: {told} {asked}");
        }
    }
}

/// A sheet of ours has such codes now and then: among the others they are read.
#[test]
fn a_code_on_a_coarser_grid_is_read_among_others() {
    let mut random = Uniform(9);
    let (mut shown, mut read_of_them) = (0, 0);
    for (seed, &family) in
        extent::of(&[Family::Ring16, Family::Metashape12, Family::Ring12, Family::Ring20], 2).iter().enumerate()
    {
        let (fine, coarse): (Vec<u32>, Vec<u32>) = family.codes().iter().partition(|code| !is_coarse(family, **code));
        let look = look(&mut random);
        let mut coded = laid_out(family, &fine, &look, &mut random);
        for target in coded.iter_mut().step_by(9) {
            target.code = coarse[(random.next() * coarse.len() as f64) as usize];
            target.number = family.number(target.code).expect("a code");
        }
        let plate = painted(coded, &look, seed as u64, |target, x, y| target.is_marked(x, y, family));
        for codes in [Codes::Auto, family.into()] {
            let found = read(&plate, codes);
            for target in &plate.coded {
                let dot = found.targets.iter().find(|dot| (dot.u - target.u).hypot(dot.v - target.v) < 2.0);
                let number = dot.and_then(|dot| dot.code);
                assert!(number.is_none_or(|number| number == target.number), "{number:?} for {}", target.number);
                if is_coarse(family, target.code) {
                    shown += 1;
                    read_of_them += usize::from(number.is_some());
                }
            }
        }
    }
    println!("{read_of_them} of {shown} read");
    assert!(shown >= 16 && 10 * read_of_them >= 7 * shown, "{read_of_them} of {shown}");
}

/// Alone it is a question, with its number as an answer.
#[test]
fn codes_on_a_coarser_grid_alone_are_candidates() {
    let family = Family::Ring14;
    let coarse: Vec<u32> = family.codes().iter().copied().filter(|code| is_coarse(family, *code)).collect();
    let mut random = Uniform(10);
    let plate = plate_of(family, &coarse, look(&mut random), &mut random, 1);
    let found = read(&plate, family.into());
    let mut asked = 0;
    for target in &plate.coded {
        let dot = found.targets.iter().find(|dot| (dot.u - target.u).hypot(dot.v - target.v) < 2.0);
        assert_eq!(dot.and_then(|dot| dot.code), None);
        asked += usize::from(dot.is_some_and(|dot| dot.code_candidates.iter().any(|c| c.number == target.number)));
    }
    assert!(10 * asked >= 7 * plate.coded.len(), "{asked}");
}

#[test]
fn the_codes_of_8_sectors_are_told() {
    let Some(bytes) = data("cases/codes_of_8_sectors.png") else { return };
    for codes in [Codes::Auto, Codes::Ring16, Codes::Ring20] {
        let options = DetectOptions { codes, ..DetectOptions::default() };
        let photo = decode::photo(&bytes, options.channel).expect("a photo");
        let Detection { targets, .. } = detect_photo(&photo, &options).expect("valid options");
        assert_eq!(targets.len(), 8);
        assert!(targets.iter().all(|target| target.code.is_none()), "{codes:?}");
        if codes != Codes::Ring20 {
            assert!(targets.iter().all(|target| target.quality.code_note == Some(CodeNote::OtherFamily)), "{codes:?}");
        }
    }
}
