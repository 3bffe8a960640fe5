//! Reasons of errors of this crate: data with an English sentence, like the engine's own.

use sightline::declare_reasons;

declare_reasons! {
    /// Why an experiment cannot be run.
    LabReason {
        // Experiments
        ImageNoise => "the standard deviation of image coordinates must be from 0.01 to 1000 µm";
        PixelNoise => "the noise of the pixels must be a share from 0 to 0.2";
        ControlSigma => "the standard error of control coordinates must be from 1e-6 to 1000 mm";
        Rounds { limit: usize } => "at most {limit} rounds of Monte Carlo";
    }
}
