//! Files that come in: photos are looked into by the workers, and what cannot be used is named while the rest goes on.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::project::{Photo, Project};
use sightline_protocol::Open;

use super::cameras::{self, Signature};
use super::document::Change;
use super::pool::{Failure, Outcome};
use super::saving::{is_project, is_text};
use super::{Desk, JobKind, PhotoFile, Problem, Reason, Step};
use crate::browser::file::NamedFile;
use crate::browser::picture::Picture;
use crate::i18n::text;

/// Longest side of the small pictures, sharp on twice as dense screens.
pub const SMALL_SIDE: u32 = 320;

type Taken = Rc<RefCell<Vec<(usize, Result<PhotoFile, Problem>)>>>;

impl Desk {
    /// Takes files wherever they were dropped.
    pub fn take(self, files: Vec<NamedFile>) {
        if files.is_empty() {
            return;
        }
        if self.job.with_untracked(Option::is_some) {
            self.warn(|| text::busy().to_owned());
            return;
        }
        let (mut projects, others): (Vec<_>, Vec<_>) = files.into_iter().partition(|f| is_project(&f.name));
        if let Some(project) = projects.pop() {
            self.open_project(project);
            return;
        }
        let (mut texts, photos): (Vec<_>, Vec<_>) = others.into_iter().partition(|f| is_text(&f.name));
        if !photos.is_empty() {
            self.take_photos(photos);
        }
        if texts.is_empty() {
            return;
        }
        if matches!(self.step.get_untracked(), Step::Control | Step::Identities) {
            if let Some(text) = texts.pop() {
                self.take_text(text);
            }
        } else {
            self.take_plates(texts);
        }
    }

    fn take_photos(self, mut files: Vec<NamedFile>) {
        files.sort_by(|a, b| natural(&a.name, &b.name));
        let taken = Taken::default();
        let keep = taken.clone();
        let batch = self.start_job(JobKind::Opening, files.len(), move || self.add_photos(&keep));
        for (place, file) in files.into_iter().enumerate() {
            let taken = taken.clone();
            let content = file.content.clone();
            let on_outcome = move |outcome: Outcome<Open>| {
                let (file, taken) = (file.clone(), taken.clone());
                spawn_local(async move {
                    let result = look_into(file, outcome).await;
                    taken.borrow_mut().push((place, result));
                    if self.step_job(batch) {
                        self.end_job();
                        self.add_photos(&taken);
                    }
                });
            };
            self.pool.with_value(|pool| {
                pool.submit(batch, Open { max_side: SMALL_SIDE }, vec![content], on_outcome);
            });
        }
    }

    /// Adds what was looked into, in the order of the file names, as one change.
    fn add_photos(self, taken: &Taken) {
        let mut all = taken.take();
        all.sort_by_key(|(place, _)| *place);
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        let mut added = 0;
        let mut problems = self.problems.get_untracked();
        for (_, result) in all {
            let file = match result {
                Ok(file) => file,
                Err(problem) => {
                    problems.push(problem);
                    continue;
                }
            };
            let known = self.files.with_untracked(|files| {
                let same = |(id, known): (&String, &PhotoFile)| {
                    (known.digest == file.digest && project.photos.iter().any(|p| p.id == *id))
                        .then(|| known.name.clone())
                };
                files.iter().find_map(same)
            });
            if let Some(of) = known {
                problems.push(Problem { file: file.name, reason: Reason::Duplicate { of } });
                continue;
            }
            let id = match self.waiting_for(&project, &file) {
                Some(id) => id,
                None => {
                    added += 1;
                    self.add_photo(&mut project, &file)
                }
            };
            self.files.update(|files| {
                files.insert(id, file);
            });
        }
        problems.dedup();
        self.problems.set(problems);
        if added > 0 {
            self.change(Change::PhotosAdded(added), |document| *document.project_mut() = project);
        }
        self.document.with_untracked(|d| {
            if let Some(photo) =
                d.project.photos.first().filter(|_| self.selection.with_untracked(|s| s.photo.is_none()))
            {
                self.select_photo(&photo.id);
            }
        });
        let empty = self.document.with_untracked(|d| d.project.photos.is_empty());
        if self.step.get_untracked() == Step::Start && !(empty && self.problems.with_untracked(Vec::is_empty)) {
            self.go(Step::Photos);
        }
    }

    /// The photo of an opened project that this file belongs to.
    fn waiting_for(self, project: &Project, file: &PhotoFile) -> Option<String> {
        self.files.with_untracked(|files| {
            let waits = |p: &&Photo| p.file == file.name && !files.contains_key(&p.id);
            project.photos.iter().find(waits).map(|p| p.id.clone())
        })
    }

    fn add_photo(self, project: &mut Project, file: &PhotoFile) -> String {
        let signature = Signature::of(&file.name, &file.info, file.size);
        let shares = |photo: &&Photo| {
            self.files.with_untracked(|files| {
                files.get(&photo.id).is_some_and(|f| Signature::of(&f.name, &f.info, f.size) == signature)
            })
        };
        let camera = match project.photos.iter().rev().find(shares) {
            Some(photo) => photo.camera.clone(),
            None => {
                let camera = cameras::camera(&signature, &file.info, project);
                let id = camera.id.clone();
                project.cameras.push(camera);
                id
            }
        };
        let largest = project.photos.iter().filter_map(|p| p.id.parse::<u32>().ok()).max().unwrap_or(0);
        let id = (largest + 1).to_string();
        project.photos.push(Photo {
            id: id.clone(),
            camera,
            file: file.name.clone(),
            enabled: true,
            ..Photo::default()
        });
        id
    }
}

async fn look_into(file: NamedFile, outcome: Outcome<Open>) -> Result<PhotoFile, Problem> {
    let NamedFile { name, content } = file;
    let failed = |reason| Problem { file: name.clone(), reason };
    match outcome {
        Outcome::Done(opened, bytes) => {
            let bytes = bytes.into_iter().next().ok_or_else(|| failed(Reason::Unreadable(String::new())))?;
            let small = Picture::from_rgba(bytes, opened.small[0], opened.small[1]).await;
            let small = small.map_err(|detail| failed(Reason::Unreadable(detail)))?;
            Ok(PhotoFile { name, content, size: opened.size, info: opened.info, small, digest: opened.digest })
        }
        Outcome::Failed(Failure::Refused(error)) => Err(failed(Reason::Engine(error))),
        Outcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => Err(failed(Reason::Unreadable(detail))),
        Outcome::Progress(nothing) => match nothing {},
    }
}

/// Order of names in which numbers count as numbers.
pub fn natural(a: &str, b: &str) -> Ordering {
    let (mut a, mut b) = (a.chars().peekable(), b.chars().peekable());
    loop {
        match (a.peek().copied(), b.peek().copied()) {
            (None, None) => return Ordering::Equal,
            (None, _) => return Ordering::Less,
            (_, None) => return Ordering::Greater,
            (Some(x), Some(y)) if x.is_ascii_digit() && y.is_ascii_digit() => {
                let number = |chars: &mut std::iter::Peekable<std::str::Chars<'_>>| {
                    let mut digits = String::new();
                    while let Some(digit) = chars.next_if(char::is_ascii_digit) {
                        digits.push(digit);
                    }
                    let digits = digits.trim_start_matches('0').to_owned();
                    (digits.len(), digits)
                };
                match number(&mut a).cmp(&number(&mut b)) {
                    Ordering::Equal => {}
                    unequal => return unequal,
                }
            }
            (Some(x), Some(y)) if x == y => {
                a.next();
                b.next();
            }
            (Some(x), Some(y)) => return x.cmp(&y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers() {
        let mut names = ["IMG_10.jpg", "IMG_9.jpg", "IMG_009b.jpg", "A.jpg", "IMG_1.jpg"];
        names.sort_by(|a, b| natural(a, b));
        assert_eq!(names, ["A.jpg", "IMG_1.jpg", "IMG_9.jpg", "IMG_009b.jpg", "IMG_10.jpg"]);
    }
}
