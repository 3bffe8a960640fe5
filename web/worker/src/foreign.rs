//! Files of other programs: sorted and read, each group by itself, so that one that is damaged does not take the others with it.

use sightline::exchange::foreign::CameraOptions;
use sightline::exchange::{self, Choices, Files, cameras, sorting};
use sightline::project::Origin;
use sightline_protocol::{Foreign, ForeignCameras};

/// Reads what is of another program.
pub fn read(files: Files, convert: bool) -> Foreign {
    let sorted = sorting::sorted(files);
    let lists = sorted.others.iter().filter(|(_, bytes)| exchange::lists::is_of_an_instrument(bytes));
    let lists = lists.map(|(name, _)| name.clone()).collect();
    let others = sorted.others.into_keys().collect();
    let mut all = Foreign { others, lists, refused: sorted.refused, ..Foreign::default() };
    let choices = Choices { convert, ..Choices::default() };
    for group in sorted.networks {
        match exchange::import_files(group.format, &group.files, &choices) {
            Ok(imported) => {
                let mut project = imported.project;
                // Formats that leave nothing open have their name and files noted all the same.
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
                };
                all.cameras.push(ForeignCameras { origin, cameras: read.cameras });
            }
            Err(error) => all.refused.push(error),
        }
    }
    all
}
