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
    outlier(first, own, position, rotation): "Photos {first} and {own} deviate by {position} and {rotation}, which chance does not explain: the mount moved, or they were not taken together. Correct the row, or delete it.";
    one_exposure: "There is only one exposure, so nothing can be compared.";
    two_cameras: "Photos taken together need two cameras with photos: assign the photos of each camera to a camera of its own.";
    no_photo(name): "No photo is named {name}: type the name of a photo, or nothing if the camera took none.";
    other_camera(photo, camera): "Photo {photo} is not of camera {camera}, to which this column belongs.";
    no_sigma(typed): "“{typed}” is not a standard error: type a number above 0. The earlier value stays.";
    change_rig: "photos taken together";
} }
