//! Texts of cameras that are fixed to each other.

use super::{English, choose};
use crate::i18n::declare;

declare! { mounted {
    rig: "Cameras fixed to each other";
    offer: "Cameras on one mount that release together: their photos share one relative pose, which makes the network stiffer.";
    means: "Photos of one row were taken together. The pose of each camera relative to the first one is estimated once and may scatter by these standard errors.";
    taken_together: "Photos were taken together";
    remove: "Cameras are independent";
    sigma_position: "σ of the relative position";
    sigma_rotation: "σ of the relative rotation";
    photo_of(row, column): "Photo of camera {column} at exposure {row}";
    base(camera, first, base): "{camera} is {base} from {first}.";
    scatter(n, position, rotation): "{n} exposures scatter by {position} and {rotation} about the common relative pose.";
    one_exposure: "One exposure alone: there is nothing to compare.";
    two_cameras: "Photos taken together need two cameras with photos: give the photos of each camera a camera of their own.";
    no_photo(name): "No photo is called {name}: type the name of a photo, or nothing where the camera took none.";
    other_camera(photo, camera): "Photo {photo} is not of camera {camera}, whose photos stand in this column.";
    no_sigma(typed): "“{typed}” is no standard error: a number greater than 0. The earlier value stays.";
    change_rig: "photos taken together";
} }
