//! Estimation on seeded networks whose truth is known: `cargo xtask bench estimation`, or with a number of samples and the
//! beginning of a network's name `cargo bench --bench estimation -- 1000 "3 photos"`: clean data of that one alone.

#![allow(dead_code, reason = "the networks are shared with the tests, which want more of them")]

#[path = "../../tests/engine/support/networks.rs"]
mod networks;
#[path = "../../tests/engine/support/trials.rs"]
mod trials;

use sightline::adjustment::{AdjustOptions, Robust};

fn main() {
    let samples = std::env::args().filter_map(|a| a.parse().ok()).next().unwrap_or(150);
    let named = std::env::args().skip(1).find(|a| !a.starts_with('-') && a.parse::<usize>().is_err());
    let with = |robust, snooping| AdjustOptions { robust, snooping, ..AdjustOptions::default() };
    let ways = [
        ("least squares", with(None, false)),
        ("snooping", with(None, true)),
        ("Huber", with(Some(Robust::Huber), false)),
        ("Tukey", with(Some(Robust::Tukey), false)),
    ];
    println!("clean data, {samples} samples each: redundancy, mean sigma0, coverage of 95 %, passed, thrown");
    let wanted = |name: &str| named.as_deref().is_none_or(|named| name.starts_with(named));
    for trial in trials::trials().into_iter().filter(|trial| wanted(trial.name)) {
        for (way, options) in &ways {
            let found = trials::clean(&trial.wanted, options, samples, 100);
            println!(
                "{:22} {way:14} r {:5}  sigma0 {:.3}  coverage {:.3}  passed {:.3}  thrown {}",
                trial.name, found.redundancy, found.sigma0, found.coverage, found.passed, found.thrown
            );
        }
    }
    if named.is_some() {
        return;
    }
    println!("gross errors of 10 to 500 sigma, {samples} samples each; sigma0 against the same noise without them");
    for trial in trials::trials() {
        for share in [0.01, 0.02, 0.05] {
            for (way, options) in &ways[1..] {
                let found = trials::spoiled(&trial.wanted, options, share, samples, 200);
                println!(
                    "{:22} {:.0} % {way:10} all found {:.3}  false {:.4}  sigma0 ratio {:.3} furthest {:.3}  thrown {}  not converged {}{}",
                    trial.name,
                    100.0 * share,
                    found.all_found,
                    found.false_alarms,
                    found.ratio,
                    found.furthest,
                    found.thrown,
                    found.not_converged,
                    if trial.well_controlled { "  (well controlled)" } else { "" }
                );
            }
        }
    }
    println!("global test at 5 %, {} samples each", 2 * samples);
    for k1 in [0.0, 5e-5, 1e-4, 2e-4, 2.56e-4] {
        let (wanted, corner) = trials::distorted(k1);
        let found = trials::clean(&wanted, &AdjustOptions::default(), 2 * samples, 300);
        println!(
            "distortion {corner:5.1} px  r {}  passed {:.3}  sigma0 {:.4}",
            found.redundancy, found.passed, found.sigma0
        );
    }
}
