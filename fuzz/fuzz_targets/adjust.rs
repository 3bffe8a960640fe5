//! Any JSON as a project, any choice of options: adjusting must end in a result or an error, no number of it NaN or infinite.
//!
//! The first byte chooses the options, the rest is the document. What is no JSON becomes a small sound network, whose tree
//! is then damaged place by place: bytes changed at random would hardly ever be a document again.
//!
//! On a stable compiler, in this folder:
//!
//! ```sh
//! RUSTC_BOOTSTRAP=1 RUSTFLAGS="--cfg fuzzing -Cdebug-assertions -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
//!   -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table" \
//!   cargo build --release --target x86_64-unknown-linux-gnu --bin adjust
//! mkdir -p corpus/adjust && target/x86_64-unknown-linux-gnu/release/adjust corpus/adjust -max_len=60000 -timeout=20 -max_total_time=400
//! mkdir -p corpus/files && target/x86_64-unknown-linux-gnu/release/files corpus/files seeds/files -timeout=20 -runs=10000000
//! ```
#![no_main]

#[path = "../../tests/engine/support/seed_document.rs"]
mod seed_document;
#[path = "../../tests/engine/support/tree.rs"]
mod tree;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use seed_document::seed_document;
use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, ResidualPlace, Robust, StatisticsChoice};
use sightline::project::Project;

/// Iterations of one document before it counts as endless: every round of data snooping has some.
const MOST_ITERATIONS: usize = 20_000;

fn options(choice: u8) -> AdjustOptions {
    AdjustOptions {
        statistics: if choice & 128 == 0 { StatisticsChoice::Full } else { StatisticsChoice::Precision },
        robust: [None, Some(Robust::Huber), Some(Robust::Tukey), None][usize::from(choice & 3)],
        snooping: choice & 4 != 0,
        residuals: if choice & 8 == 0 { ResidualPlace::Corrected } else { ResidualPlace::Measured },
        unmodelled: if choice & 16 == 0 { 0.0 } else { 0.05 },
        covariance_of: if choice & 32 == 0 { Vec::new() } else { vec!["p1".into(), "p4".into()] },
        ..AdjustOptions::default()
    }
}

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let mut state = u64::from(seed) | 1 << 40;
    let mut below = |n: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % n.max(1)
    };
    let (head, text) = data[..size].split_at(size.min(1));
    let mut choice = head.first().copied().unwrap_or(0);
    let mut document = match serde_json::from_slice(text) {
        Ok(document) => document,
        Err(_) => serde_json::to_value(seed_document(seed)).expect("a document"),
    };
    if below(4) == 0 {
        choice = below(256) as u8;
    }
    for _ in 0..1 + below(4) {
        tree::damage(&mut document, &mut below);
    }
    let text = serde_json::to_vec(&document).unwrap_or_default();
    if text.len() + 1 > max_size.min(data.len()) {
        return libfuzzer_sys::fuzzer_mutate(data, size, max_size);
    }
    data[0] = choice;
    data[1..=text.len()].copy_from_slice(&text);
    text.len() + 1
});

fuzz_target!(|data: &[u8]| {
    let Some((choice, text)) = data.split_first() else { return };
    let Ok(project) = serde_json::from_slice::<Project>(text) else { return };
    let mut iterations = 0;
    let adjusted = adjust(&project, &options(*choice), &mut |_| {
        iterations += 1;
        assert!(iterations < MOST_ITERATIONS, "endless");
        true
    });
    match adjusted {
        Ok(adjustment) => {
            assert!(tree::is_finite(&format!("{adjustment:?}")));
            assert!(tree::is_finite(&format!("{:?}", apply(&project, &adjustment))));
        }
        Err(error) => assert!(tree::is_finite(&format!("{error:?}")), "{error:?}"),
    }
});
