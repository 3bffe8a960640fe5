//! Reasons of errors of this crate: data with an English sentence, like the engine's own.

use sightline::declare_reasons;
use sightline::error::Number;

declare_reasons! {
    /// Why a report or sheets of targets cannot be made.
    ReportReason {
        // Sheets to print
        SheetNothing => "there is nothing to print: ask for codes, dots, scale bars or a calibration field";
        SheetDiameter { value: Number } => "a dot of {value} mm cannot be printed: 0.5 to 400 mm are supported";
        SheetRuler { value: Number, length: Number } => "the ruler of {length} mm measures {value}: a value between half and twice its length is expected";
        SheetBar { value: Number } => "a scale bar of {value} mm: a length above 0 and up to a kilometre is expected";
        SheetNumbers { text: String } => "\"{text}\" is not a list of numbers: write it as 1-20, 35";
        SheetNumberUnknown { number: u32, family: usize } => "there is no code {number}: the family has the numbers 1 to {family}";
        SheetTooManyCodes { wanted: usize, family: usize } => "{wanted} codes are requested, but the family has {family}: request fewer, or use a family with more bits";
        SheetTooManyTargets { limit: usize } => "more than {limit} targets: print them in parts";
        SheetTooMany { limit: usize } => "more than {limit} sheets: print them in parts";
        SheetNoRoom { value: Number, width: Number, height: Number } => "a dot of {value} mm with its surroundings does not fit on paper of {width} x {height} mm: use larger paper or smaller dots";
        SheetAdvice => "principal distance, distances and diameter must be above 0, angles below 89°";

        // The report
        OtherAdjustment => "the result belongs to another state of the project: adjust again";
    }
}
