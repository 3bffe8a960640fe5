//! Writes the equations of a project as matrices that NumPy and SciPy read: `equations FOLDER [PROJECT.json]`; without a project those of
//! the lab net, under control and as a free network, into two folders.

use std::path::Path;

use sightline::adjustment::AdjustOptions;
use sightline::project::{Datum, DatumKind, Project};
use sightline_lab::teaching::{files, lab, moved};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = Path::new(arguments.first().ok_or("equations FOLDER [PROJECT.json]")?);
    if let Some(file) = arguments.get(1) {
        return write(&folder.join("project"), &serde_json::from_str(&std::fs::read_to_string(file)?)?);
    }
    let project = moved(&lab()?, 0.001);
    write(&folder.join("control"), &project)?;
    write(&folder.join("free"), &Project { datum: Datum { kind: DatumKind::Free, points: None }, ..project })
}

fn write(folder: &Path, project: &Project) -> Result<(), Box<dyn std::error::Error>> {
    std::fs::create_dir_all(folder)?;
    for (name, bytes) in files(project, &AdjustOptions::default())? {
        std::fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
