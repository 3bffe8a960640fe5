//! What an encoder leaves of a picture moves centres by as much as their sigmas say.

use sightline::detect::detect;
use sightline::detection::{Codes, DetectOptions};

use crate::support::compression::{Shot, Sums};
use crate::support::extent;

#[test]
fn sigmas_of_compressed_pictures_are_those_of_their_errors() {
    let options = DetectOptions { codes: Codes::None, ..DetectOptions::default() };
    let (mut all, mut fine, mut coarse) = (Sums::default(), Sums::default(), Sums::default());
    for seed in 0..extent::cases(16, 150) as u64 {
        let shot = Shot::drawn(seed);
        let (grey, spots) = shot.picture(seed);
        let found = detect(&grey.view().expect("a picture"), &options).expect("valid options");
        all.add(&found, &spots);
        let part = if shot.quality >= 75 { &mut fine } else { &mut coarse };
        part.add(&found, &spots);
    }
    for (name, sums) in [("all", all), ("quality 75 to 98", fine), ("quality 50 to 74", coarse)] {
        let honest = sums.honest();
        println!("{name}: {} of {}, error/sigma {honest:.3}, at most {:.1}", sums.hits, sums.targets, sums.largest);
        assert!((0.8..1.2).contains(&honest), "{name}: error/sigma {honest}");
        assert!(10 * sums.hits >= 9 * sums.targets, "{name}: {} of {}", sums.hits, sums.targets);
    }
}
