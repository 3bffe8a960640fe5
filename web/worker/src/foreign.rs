//! Files of other programs: sorted into groups and read. Each group is read separately, so that a damaged file affects only its group.

use std::collections::BTreeMap;

use sightline::project::Origin;
use sightline_exchange::foreign::CameraOptions;
use sightline_exchange::{self as exchange, Choices, Files, cameras, sorting};
use sightline_protocol::{Foreign, ForeignCameras};

/// Reads the files of other programs; `sizes` are the sizes of photos by their file names.
pub fn read(files: Files, sizes: BTreeMap<String, [u32; 2]>, convert: bool) -> Foreign {
    let sorted = sorting::sorted(files);
    let lists = sorted.others.iter().filter(|(_, bytes)| exchange::lists::is_of_an_instrument(bytes));
    let lists = lists.map(|(name, _)| name.clone()).collect();
    let others = sorted.others.into_keys().collect();
    let mut all = Foreign { others, lists, refused: sorted.refused, ..Foreign::default() };
    let choices = Choices { convert, sizes, ..Choices::default() };
    for group in sorted.networks {
        match exchange::import_files(group.format, &group.files, &choices) {
            Ok(imported) => {
                let mut project = imported.project;
                // Formats without assumptions also need their name and files recorded.
                let origin = project.origin.get_or_insert_default();
                origin.format = group.format.to_owned();
                origin.files = group.files.into_keys().collect();
                all.networks.push(project);
            }
            Err(error) => all.refused.push(error),
        }
    }
    let options = CameraOptions { convert, ..CameraOptions::default() };
    for group in sorted.cameras {
        match cameras::import(group.format, &group.files, &options) {
            Ok(read) => {
                let origin = Origin {
                    format: read.format.to_owned(),
                    files: group.files.into_keys().collect(),
                    assumed: read.assumed,
                    ignored: read.ignored,
                    conversions: Vec::new(),
                    local_system: None,
                };
                all.cameras.push(ForeignCameras { origin, cameras: read.cameras });
            }
            Err(error) => all.refused.push(error),
        }
    }
    all
}
