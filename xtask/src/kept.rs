//! What `serve` makes of files that have not changed since is not made again: it lies beside what cargo built, with the digest of what it was
//! made from.

use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::Outcome;
use crate::build::write;
use crate::page::copy_folder;

/// Leaves in `into` what `make` leaves in a folder: kept below `shelf` under `name`, and made again when one of the `sources` has another
/// content or the program that makes it is another.
pub fn product(
    shelf: &Path,
    name: &str,
    sources: &[PathBuf],
    into: &Path,
    make: impl FnOnce(&Path) -> Outcome,
) -> Outcome {
    let (folder, stamp) = (shelf.join(name), shelf.join(format!("{name}.made-from")));
    let digest = digest(sources)?;
    if fs::read_to_string(&stamp).map_or(true, |made_from| made_from != digest) {
        // A product that is not finished has no stamp.
        if stamp.exists() {
            fs::remove_file(&stamp).map_err(|error| format!("{}: {error}", stamp.display()))?;
        }
        crate::build::empty(&folder)?;
        make(&folder)?;
        write(&stamp, digest.as_bytes())?;
    }
    copy_folder(&folder, into)
}

/// Of the files' contents, and of this program: by its time, as it is large and changes seldom.
fn digest(sources: &[PathBuf]) -> Outcome<String> {
    let program = std::env::current_exe().and_then(fs::metadata).map_err(|error| format!("this program: {error}"))?;
    let built = program.modified().map_err(|error| format!("this program: {error}"))?;
    let mut text = format!("{built:?} {}\n", program.len());
    for source in sources {
        let bytes = fs::read(source).map_err(|error| format!("{}: {error}", source.display()))?;
        text += &format!("{} {:x}\n", source.display(), Sha256::digest(bytes));
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_is_made_again_when_what_it_is_made_from_changes() {
        let folder = std::env::temp_dir().join(format!("sightline-kept-{}", std::process::id()));
        let (source, shelf, into) = (folder.join("source"), folder.join("shelf"), folder.join("into"));
        fs::create_dir_all(&into).expect("a folder");
        let mut made = 0;
        let mut serve = |content: &str, works: bool| {
            write(&source, content.as_bytes()).expect("a source");
            let outcome = product(&shelf, "upper", std::slice::from_ref(&source), &into, |folder| {
                made += 1;
                write(&folder.join("deep.txt"), content.to_uppercase().as_bytes())?;
                if works { Ok(()) } else { Err("no".into()) }
            });
            (outcome.is_ok(), made, fs::read_to_string(into.join("deep.txt")).unwrap_or_default())
        };
        assert_eq!(serve("a", true), (true, 1, "A".into()));
        // Written again, but the same.
        assert_eq!(serve("a", true), (true, 1, "A".into()));
        assert_eq!(serve("b", true), (true, 2, "B".into()));
        // What failed half way is not taken for what was wanted, neither now nor later.
        assert_eq!(serve("c", false), (false, 3, "B".into()));
        assert_eq!(serve("c", true), (true, 4, "C".into()));
        fs::remove_dir_all(folder).expect("removed");
    }
}
