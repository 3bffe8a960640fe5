//! Any bytes as a HEIC or a RAW: opened with and without their samples, then measured. Each must end in a result or an error, in bounded
//! memory: `cargo +nightly fuzz run codecs -- -rss_limit_mb=2048 -timeout=10`. Files to begin with: `cargo run --package sightline-codecs --example written
//! -- FOLDER`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sightline::detect::detect_shot;
use sightline::detection::{Channel, DetectOptions};
use sightline::sensor::{self, Unpacked};
use sightline_codecs::{Wanted, unpack};

const CHANNELS: [Channel; 4] = [Channel::Grey, Channel::Red, Channel::Green, Channel::Blue];

fuzz_target!(|data: &[u8]| {
    let Some((choice, file)) = data.split_last() else { return };
    let channel = CHANNELS[usize::from(*choice) % CHANNELS.len()];
    let _ = unpack(file, Wanted { channel, samples: false, max_side: 320 });
    let Ok(shot) = unpack(file, Wanted::samples(channel)).and_then(Unpacked::into_shot) else { return };
    let _ = sensor::picture(&shot, 320);
    let _ = sensor::part(&shot, [usize::from(*choice), 0], 64);
    // large inputs take long to search and reach no other code
    if shot.bytes() < 1 << 20 {
        let _ = detect_shot(&shot, &DetectOptions { channel, ..DetectOptions::default() });
    }
});
