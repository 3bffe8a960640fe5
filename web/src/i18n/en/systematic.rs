//! Texts of systematic residuals: what they depend on, the cause, what to do.

use super::{English, choose};
use crate::i18n::declare;

declare! { systematic {
    radius(camera, px): "Camera {camera}: the residuals depend on the radius, up to {px} px";
    radius_body: "Cause: radial lens distortion that the camera model does not describe.";
    tangential(camera, px): "Camera {camera}: the residuals have a tangential pattern, up to {px} px";
    tangential_body: "Cause: decentring distortion or a shifted principal point.";
    affine(camera, px): "Camera {camera}: the scales along rows and columns differ, up to {px} px";
    affine_body: "Cause: the pixels are not square, or the image axes are not perpendicular.";
    row(camera, px): "Camera {camera}: the residuals grow with the row, up to {px} px";
    column(camera, px): "Camera {camera}: the residuals grow with the column, up to {px} px";
    read_out_body: "Cause: the camera or the object moved while the sensor was read out (rolling shutter).";
    position(camera, px): "Camera {camera}: all photos have the same pattern of residuals, up to {px} px";
    position_body: "Cause: a smooth deformation of the image that no parameter of a camera model describes.";
    photo(photos, px): "The interior orientation of {photos} differs from the other photos, up to {px} px";
    photo_body: "Cause: changed zoom or focus, cropping, or another image size.";
    every_photo(camera, px): "Camera {camera}: the interior orientation changes from photo to photo, up to {px} px";
    every_photo_body: "Cause: zoom or autofocus.";
    estimate(parameters): "Estimate {parameters}.";
    estimate_now(parameters): "Estimate {parameters}";
    other_model(models): "This lens needs another camera model: {models}.";
    hold_still: "Hold camera and object still, expose briefly or with flash, or use a camera with a global shutter.";
    own_camera: "Give these photos a camera of their own.";
    per_photo: "Fix zoom and focus when photographing, or estimate an interior orientation per photo.";
    inspect: "Check for a window in front of the lens, an uneven sensor or film, or targets measured off centre.";
    photos_tested(n): "{n} {n:photo|photos} tested one by one";
    not_noise: "This is a systematic error, not noise: the standard errors of the result do not include it.";
} }
