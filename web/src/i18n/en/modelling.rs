//! Texts of camera models: chosen, converted, compared.

use super::{English, choose};
use crate::i18n::declare;

declare! { modelling {
    camera_model: "Camera model";
    converting: "converting the camera";
    converted(from, max, rms): "Converted from {from}: image points differ by at most {max} px (rms {rms} px).";
    converted_part(percent): "This holds for {percent} % of the picture; this model has no image of what lies farther off the axis.";
    converted_unknown: "The principal distance is not known yet: the distortion begins at 0.";
    dropped(parameters): "A priori values of {parameters} have no place in this model.";
    compare: "Compare models";
    compare_why: "Adjusts the network with each camera model and says which of them the photos support. Gross errors are to be disabled before.";
    comparing: "comparing camera models";
    parameters: "Parameters";
    held_out: "Held out";
    held_out_why: "Root mean square of a fifth of the image coordinates, predicted without them.";
    bic_why: "Schwarz's criterion less that of the best model: misfit and number of parameters together. More than 10 is clear.";
    best: "Best supported by the photos";
    as_good_with_fewer: "Fits as well, with fewer parameters";
    as_good: "Fits as well";
    too_stiff: "Fits worse: it cannot follow this lens as well";
    overfits: "Fits no better, with more parameters";
    failed: "Could not be adjusted";
    not_told(parameters): "Not told from 0: {parameters}";
    in_use: "in use";
    take: "Use";
    compared_note: "After a change of the model, adjust again.";
    change_model(camera, model): "camera {camera} has the model {model}";
} }
