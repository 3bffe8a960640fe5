//! Choosers for files.

use crate::browser::file;
use crate::store::Desk;

/// Opens the chooser for a project file, or the text files of plates.
pub fn choose_project(desk: Desk) {
    file::choose(
        ".sightline,.zip,.json,.csv,.txt,.xml,.yml,.yaml,.sfm,.out,.bin,.cameramodel,.nvm,.psz",
        true,
        move |files| desk.take_dropped(files),
    );
}

/// Opens the chooser for photos.
pub fn choose_photos(desk: Desk) {
    file::choose(
        ".jpg,.jpeg,.png,.tif,.tiff,.heic,.heif,.dng,.nef,.nrw,.cr2,.cr3,.arw,.orf,.rw2,.raf,.pef,.srw,image/*",
        true,
        move |files| {
            desk.take_dropped(files);
        },
    );
}
