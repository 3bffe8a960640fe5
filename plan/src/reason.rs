//! Reasons of errors of this crate: data with an English sentence, like the engine's own.

use sightline::declare_reasons;

declare_reasons! {
    /// Why a plan, a network on paper or a picture of one cannot be made.
    PlanReason {
        // The project file
        CannotWritePicture { message: String } => "the picture cannot be written: {message}";

        // Networks on paper and pictures of them
        Noise => "noise must be a standard deviation of 0 or more pixels";
        Margin => "the margin must be a number of pixels";
        Incidence => "the maximum incidence must be an angle in radians";
        StationNotFinite => "position and roll of a station must be finite numbers";
        StationAngles => "the angles of a station must be finite numbers";
        StationDirection => "a station needs a rotation or a point to look at";
        StationAim => "a station cannot look at itself";
        Face { index: usize } => "face {index} is not a parallelogram with a finite grey level and a grain above 0";
        Disc => "a target needs a finite centre, a direction and a diameter above 0";
        Exposure => "an exposure needs a point spread from 0.3 to 10 pixels, vignetting and noise from 0 to 1 and 8 or 16 bits";

        // Plans
        PlanCamera => "a plan needs a camera";
        FormTooMany { limit: usize } => "a form has at most {limit} targets: use fewer columns or rows";
        PlanTooLarge { limit: usize } => "targets times photos exceed {limit}: plan a part of the object";
        PlanLeastPixels => "the minimum target size must be a number of pixels from 0";
        PlanWanted => "the required accuracy must be a length above 0, with a probability from 0.5 to 0.999";
        PlanLens => "f-number, focused distance and circle of confusion must be above 0";
        PlanNothingSeen => "no photo of this camera sees four targets: use larger targets, a longer lens or fewer places without access";
    }
}
