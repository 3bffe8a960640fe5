//! Time of a comparison of epochs and how often its tests are right, natively: `cargo xtask bench epochs`. The rates are those of the
//! tests of the full extent, with their seeds and limits.

#![allow(dead_code, reason = "epochs and networks are shared with the tests, which want more of them")]

/// Shared by the simulations and the tests.
#[path = "."]
mod support {
    #[path = "../../tests/engine/support/epochs.rs"]
    pub mod epochs;
    #[path = "../../tests/engine/support/networks.rs"]
    pub mod networks;
}
#[path = "../../tests/engine/monitoring/simulated.rs"]
mod simulated;

use std::time::Instant;

use nalgebra::Vector3;
use sightline::monitoring::{Epoch, Options, compare_epochs};
use support::epochs::{Made, epoch, object, references};

fn main() {
    println!(
        "points x epochs with full covariances, 12 reference points: seconds, best of three; asked for 200 x 12: 3"
    );
    for (points, count) in [(50, 2), (200, 2), (200, 12), (400, 12)] {
        let object = object(3, 12, points - 12);
        let all: Vec<Epoch> = (0..count)
            .map(|k| {
                let moved = [(20, Vector3::new(0.1 * k as f64, 0.0, 0.0))];
                let made = Made { turned: false, redundancy: 2000, ..Made::new(60 + k) };
                Epoch { date: Some(format!("2026-{:02}-01", k + 1)), ..epoch(&k.to_string(), &object, &moved, &made) }
            })
            .collect();
        let options = Options { reference: Some(references(12)), ..Options::default() };
        let once = || {
            let began = Instant::now();
            let found = compare_epochs(&all, &options).expect("comparable");
            assert_eq!(found.series.len(), points);
            began.elapsed().as_secs_f64()
        };
        println!("{points:5} x {count:2}  {:.2}", (0..3).map(|_| once()).fold(f64::MAX, f64::min));
    }
    simulated::in_full();
}
