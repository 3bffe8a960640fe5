//! Ring codes in photos that a camera has developed: a tone curve, then a sharpening.

use crate::support::coded_photo::{Development, photo};
use crate::support::extent;
use crate::support::painter::Uniform;
use sightline::detect::detect;
use sightline::detection::{DetectOptions, Detection};
use sightline::ring_code::Family;

#[test]
fn codes_of_sharpened_and_bent_photos_are_read_or_noted_and_their_sectors_are_no_targets() {
    let (mut all, mut dots, mut read, mut loose) = (0, 0, 0, 0);
    for seed in 1..=extent::cases(8, 64) as u64 {
        let mut random = Uniform(91 * seed + 7);
        random.next();
        let family = Family::ALL[(seed % 8) as usize];
        let how = Development::drawn(&mut random);
        let (picture, coded) = photo(&mut random, family, [5.0, 14.0], &how, seed);
        let options = DetectOptions { codes: family.into(), ..DetectOptions::default() };
        let Detection { targets, .. } = detect(&picture.view().expect("a picture"), &options).expect("valid options");
        let (mut own, mut others) = (0, 0);
        for target in &targets {
            let Some(code) = coded.iter().find(|code| (code.u - target.u).hypot(code.v - target.v) < 2.0) else {
                others += 1;
                assert_eq!(target.code, None, "{seed}: {target:?}");
                continue;
            };
            dots += 1;
            assert!(target.code.is_none_or(|number| number == code.number), "{seed} {family:?} {how:?}: {target:?}");
            own += usize::from(target.code.is_some());
        }
        println!("{seed} {family:?} {how:.2?}: {own} of {} read, {others} beside", coded.len());
        (all, read, loose) = (all + coded.len(), read + own, loose + others);
    }
    println!("{dots} dots of {all}, {read} read, {loose} sectors left");
    assert!(100 * dots >= 98 * all, "{dots} of {all}");
    assert!(READ.0 * all <= 100 * read, "{read} of {all}");
    assert!(100 * loose <= READ.1 * all, "{loose} of {all}");
}

/// Minimum number of codes read, and maximum number of sectors taken for targets, per hundred codes.
const READ: (usize, usize) = (85, 10);
