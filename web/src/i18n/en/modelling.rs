//! Texts of camera models: chosen, converted, compared.

use super::{English, choose};
use crate::i18n::declare;

declare! { modelling {
    camera_model: "Camera model";
    converting: "converting the camera";
    converted(from, max, rms): "Converted from {from}: image points differ by at most {max} px (rms {rms} px).";
    converted_part(percent): "This holds for {percent} % of the image; farther from the axis this model cannot project points.";
    converted_unknown: "The principal distance is not known yet, so the distortion starts at 0.";
    dropped(parameters): "A priori values of {parameters} do not exist in this model.";
    compare: "Compare models";
    compare_why: "Adjusts the network with each camera model and shows which of them the photos support. Switch off gross error handling first.";
    comparing: "comparing camera models";
    parameters: "Parameters";
    held_out: "Cross-validation";
    held_out_why: "Root mean square error of a fifth of the image coordinates, predicted without them.";
    bic_why: "Bayesian information criterion (Schwarz) minus that of the best model: it weighs misfit against the number of parameters. A difference above 10 is clear.";
    best: "Best supported by the photos";
    as_good_with_fewer: "Equally good, with fewer parameters";
    as_good: "Equally good";
    too_stiff: "Worse: it cannot describe this lens as well";
    overfits: "No better, with more parameters";
    failed: "Could not be adjusted";
    not_told(parameters): "Not significantly different from 0: {parameters}";
    in_use: "in use";
    take: "Use";
    compared_note: "Adjust again after changing the model.";
    change_model(camera, model): "model of camera {camera} set to {model}";
} }
