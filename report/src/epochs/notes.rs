//! Notes of a pair of epochs and assumptions about its epochs, as sentences.

use sightline::monitoring::{EpochNote, Monitoring, Pair, PairNote};
use sightline::project::ReportLanguage;

use super::listed;
use crate::number::fixed;
use crate::texts::words;

/// Notes on a pair of epochs, with remedies.
pub fn notes(pair: &Pair, language: ReportLanguage) -> Vec<String> {
    let w = words(language);
    let names = |points: &[String]| listed(points, language);
    let one = |note: &PairNote| match note {
        PairNote::VariancesDiffer => w.epochs_note_variances_differ().to_owned(),
        PairNote::ScaleDiffers => w.epochs_note_scale_differs().to_owned(),
        PairNote::SigmasTooSmall { factor } => w.epochs_note_sigmas_too_small(&fixed(*factor, 2)),
        PairNote::NoMajority { stable, reference } => w.epochs_note_no_majority(stable, reference),
        PairNote::AnotherGroup { points } => w.epochs_note_another_group(&names(points)),
        PairNote::WeaklyControlled { points } => w.epochs_note_weakly_controlled(&names(points)),
        PairNote::SecondOpinionDiffers { points } => w.epochs_note_second_opinion_differs(&names(points)),
        PairNote::NoStableGroup => w.epochs_note_no_stable_group().to_owned(),
        PairNote::CameraDiffers { camera } => w.epochs_note_camera_differs(camera),
        PairNote::NotJoint => w.epochs_note_not_joint().to_owned(),
        PairNote::TooManyTogether { points, limit } => w.epochs_note_too_many_together(points, limit),
    };
    pair.notes.iter().map(one).collect()
}

/// Assumptions about the epochs of a pair.
pub fn assumed(found: &Monitoring, pair: &Pair, language: ReportLanguage) -> Vec<String> {
    let w = words(language);
    let mut all = Vec::new();
    for epoch in found.epochs.iter().filter(|e| [&pair.from, &pair.to].contains(&&e.name)) {
        let name = &epoch.name;
        all.extend(epoch.notes.iter().map(|note| match note {
            EpochNote::NoCovariance => w.epochs_note_no_covariance(name),
            EpochNote::NoRedundancy => w.epochs_note_no_redundancy(name),
            EpochNote::ControlReleased { points } => w.epochs_note_control_released(name, &listed(points, language)),
        }));
        all.extend((!epoch.scaled).then(|| w.epochs_note_not_scaled(name)));
    }
    all
}
