//! Project files: saving, opening, exporting, and the sample project.

use std::collections::{BTreeMap, HashSet, VecDeque};
use std::rc::Rc;
use std::sync::Arc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::detection::Detection;
use sightline::project::Project;
use sightline_protocol::{Content, Export, Pack, Unpack, Unpacked};

use super::background::Stop;
use super::persistence::Kept;
use super::pool::{Failure, TaskOutcome};
use super::{Asking, Desk, JobKind, Step, Until};
use crate::browser::file::{self, Blob, NamedFile};
use crate::browser::page;
use crate::browser::worker::Bytes;
use crate::document::{self, Document};
use crate::i18n::background as words;
use crate::i18n::{Text, errors, text};

/// Ending of project files.
pub const EXTENSION: &str = "sightline";

/// Whether a file name is that of a project.
pub fn is_project(name: &str) -> bool {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    matches!(ending.as_str(), "zip" | "json" | EXTENSION)
}

/// Whether a file name is that of a project in an archive.
pub fn is_packed(name: &str) -> bool {
    is_project(name) && !name.to_ascii_lowercase().ends_with(".json")
}

/// Whether a file name is that of a table or list.
pub fn is_text(name: &str) -> bool {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    matches!(ending.as_str(), "txt" | "csv" | "tsv" | "dat")
}

/// How often, and at what distance in milliseconds, it is looked whether the storage has answered; then it counts as missing.
const STORAGE_ROUNDS: usize = 200;
const STORAGE_MS: i32 = 50;

impl Desk {
    /// Writes the project file and hands it over; the photos go along on request.
    pub fn save(self, with_photos: bool) {
        self.save_then(with_photos, Rc::new(|| ()));
    }

    fn save_then(self, with_photos: bool, then: Rc<dyn Fn()>) {
        let document = self.document.get_untracked();
        let mut names = Vec::new();
        let mut files = Vec::new();
        let mut content = content(&document);
        if with_photos {
            name_apart(&mut content.project);
            self.photos.files.with_untracked(|all| {
                for photo in &content.project.photos {
                    if let Some(file) = all.get(&photo.id) {
                        names.push(photo.file.clone());
                        files.push(file.content.clone());
                    }
                }
            });
        }
        let task = Pack { content, names };
        let photos = files.clone();
        let batch = self.start_job(JobKind::Saving, 1, || {});
        let on_outcome = move |outcome: TaskOutcome<Pack>| {
            self.end_job();
            match outcome {
                TaskOutcome::Done((), bytes) => {
                    let name = format!("{}.{EXTENSION}", file_stem(&document.project.name));
                    match file::download_around(&name, "application/zip", &bytes, &photos) {
                        Ok(()) => {
                            self.persistence.saved.set(Some((page::clock(), document.clone())));
                            if !photos.is_empty() {
                                self.tell(|| text::photos_carry_places().to_owned());
                            }
                            then();
                        }
                        Err(detail) => self.say(true, Until::NextWork, move || text::cannot_save(&detail)),
                    }
                }
                TaskOutcome::Failed(failure) => self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, task, files, on_outcome));
    }

    /// Tells why a task gave nothing.
    pub(super) fn tell_failure(self, failure: Failure) {
        match failure {
            Failure::Refused(error) => self.warn_error(error),
            Failure::Unreadable(detail) | Failure::Lost(detail) => self.warn_crash(detail),
        }
    }

    /// Replaces the open project by another; asks first if there are unsaved changes.
    pub(super) fn over_unsaved(self, then: impl Fn() + 'static) {
        let then: Rc<dyn Fn()> = Rc::new(then);
        let is_starting = move || self.persistence.kept.with_untracked(|kept| *kept == Kept::Starting);
        if !is_starting() || !untrack(|| self.unsaved_work()) {
            return self.over_unkept(then);
        }
        // Whether the open project is lost by opening another is known when the storage has answered.
        spawn_local(async move {
            for _ in 0..STORAGE_ROUNDS {
                if !is_starting() {
                    break;
                }
                page::pause(STORAGE_MS).await;
            }
            self.over_unkept(then);
        });
    }

    /// The same, once it is known whether the open project is kept.
    fn over_unkept(self, then: Rc<dyn Fn()>) {
        // What is kept is not lost by opening another.
        if self.keeps() || !untrack(|| self.unsaved_work()) {
            return then();
        }
        let save: Rc<dyn Fn()> = {
            let then = then.clone();
            Rc::new(move || self.save_then(true, then.clone()))
        };
        let name = self.document.with_untracked(|d| d.project.name.clone());
        let text =
            Rc::new(move || if name.is_empty() { text::unsaved_here().to_owned() } else { text::unsaved_in(&name) });
        let choices = vec![(text::save_first as Text, save), (text::go_on_unsaved as Text, then)];
        self.messages.asking.set(Some(Asking { text, choices }));
    }

    /// Opens a project file; the one that is open can be got back by undoing.
    pub fn open_project(self, file: NamedFile) {
        if file.content.is_empty() {
            let name = file.name;
            return self.say(true, Until::NextWork, move || text::file_empty(&name));
        }
        self.over_unsaved(move || self.unpack(file.clone()));
    }

    fn unpack(self, file: NamedFile) {
        let batch = self.start_job(JobKind::OpeningProject, 1, || {});
        let (name, packed) = (file.name.clone(), file.content.clone());
        let on_outcome = move |outcome: TaskOutcome<Unpack>| {
            self.end_job();
            match outcome {
                TaskOutcome::Done(Unpacked { content, names, places, damaged }, bytes) => {
                    let stem = name.rsplit_once('.').map_or(name.as_str(), |(stem, _)| stem).to_owned();
                    // Photos stay in the file until they are copied.
                    let mut unpacked = bytes.iter();
                    let photo = |place: Option<(u64, u64)>| match place {
                        Some((start, size)) => packed.part(start as f64, size as f64).ok(),
                        None => unpacked.next().and_then(|bytes| Blob::from_bytes(bytes).ok()),
                    };
                    let photos = places.into_iter().map(photo).collect::<Vec<_>>();
                    let named = names.into_iter().zip(photos);
                    let named = named.filter_map(|(name, content)| Some(NamedFile { name, content: content? }));
                    self.take_content(content, &stem, named.collect());
                    let document = self.document.get_untracked();
                    self.persistence.saved.set(Some((page::clock(), document)));
                    if !damaged.is_empty() {
                        let told = move || damaged.iter().map(errors::sentence).collect::<Vec<_>>().join(" ");
                        self.warn(told);
                    }
                }
                TaskOutcome::Failed(Failure::Refused(error)) => self.warn_error(error.in_file(&name)),
                TaskOutcome::Failed(failure) => self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            }
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, Unpack {}, vec![file.content], on_outcome));
    }

    /// Puts a document on the desk, with the photos that came with it.
    pub(super) fn take_content(self, content: Content, stem: &str, photos: Vec<NamedFile>) {
        let mut project = content.project;
        if project.name.is_empty() {
            project.name = stem.to_owned();
        }
        let adjusted = content.adjustment.is_some();
        let project = Arc::new(project);
        let options = content.adjustment.as_ref().map(|adjustment| adjustment.options.clone()).unwrap_or_default();
        let result = content.adjustment.map(|adjustment| {
            let (input, oriented) = (project.clone(), project.clone());
            Arc::new(document::AdjustmentResult { input, oriented, adjustment })
        });
        let detections = content.targets.into_iter().map(|(photo, d)| (photo, Arc::new(d))).collect::<BTreeMap<_, _>>();
        let first = project.photos.first().map(|p| p.id.clone());
        self.begin(Document { project, detections: Arc::new(detections), options, result, ..Document::default() });
        self.processing.iterations.set(
            self.document
                .with_untracked(|d| d.result.as_ref().map(|r| r.adjustment.iterations.clone()).unwrap_or_default()),
        );
        self.forget_waiting();
        self.photos.files.set(BTreeMap::new());
        self.photos.others.set_value(Vec::new());
        self.selection.set(super::Selection { photo: first, ..Default::default() });
        self.go(if adjusted { Step::Results } else { Step::Photos });
        if !photos.is_empty() {
            self.take(photos);
        }
    }

    /// Cancels tasks of the previous project and releases its pictures.
    pub(super) fn forget_waiting(self) {
        self.end_modes();
        self.photos.pictures.set(Vec::new());
        self.processing.notes.set(Vec::new());
        self.processing.adjust_failure.set(None);
        self.intake.marks.set(None);
        self.intake.pasted.set(None);
        self.intake.next_lists.set(VecDeque::new());
        self.intake.distances.set(None);
        self.intake.problems.set(Vec::new());
    }

    /// Hands over a file of the engine's making.
    pub fn export(self, format: &str) {
        let task = self.document.with_untracked(|d| Export {
            format: format.to_owned(),
            project: (*d.project).clone(),
            adjustment: d.current().map(|result| result.adjustment.clone()),
        });
        let stem = file_stem(&task.project.name);
        let on_outcome = move |outcome: TaskOutcome<Export>| match outcome {
            TaskOutcome::Done(names, bytes) => {
                for (name, bytes) in names.iter().zip(bytes) {
                    let table = name.ends_with(".csv") || name.ends_with(".tsv");
                    let kind = if table { "text/csv" } else { "application/octet-stream" };
                    self.hand_over(&format!("{stem}-{name}"), kind, &bytes);
                }
            }
            TaskOutcome::Failed(failure) => self.tell_failure(failure),
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.ask(Stop(words::file, || ()), task, Vec::new(), on_outcome);
    }

    /// Gives a file to the browser to save.
    pub(super) fn hand_over(self, name: &str, kind: &str, bytes: &Bytes) {
        if let Err(detail) = file::download_around(name, kind, std::slice::from_ref(bytes), &[]) {
            self.say(true, Until::NextWork, move || text::cannot_save(&detail));
        }
    }

    /// Marks the document as not changed by the user.
    pub(super) fn is_pristine(self) {
        self.persistence.pristine.set(Some(self.document.get_untracked()));
    }

    /// Whether someone's work would be lost: what can be computed again does not count.
    fn unsaved_work(self) -> bool {
        let same = |d: &Document, other: &Document| {
            Arc::ptr_eq(&d.project, &other.project) && Arc::ptr_eq(&d.detections, &other.detections)
        };
        self.document.with(|d| {
            let saved = self.persistence.saved.with(|s| s.as_ref().is_some_and(|(_, saved)| same(d, saved)));
            !d.is_empty() && !saved && !self.persistence.pristine.with(|p| p.as_ref().is_some_and(|p| same(d, p)))
        })
    }

    /// Whether something would be lost with the page.
    pub fn unsaved(self) -> bool {
        if self.keeps() {
            return self.unwritten();
        }
        self.document.with(|d| {
            !d.is_empty() && self.persistence.saved.with(|s| s.as_ref().is_none_or(|(_, saved)| !d.same(saved)))
        })
    }

    pub fn rename_project(self, name: &str) {
        if self.may_change() {
            self.document.update(|d| rename(d, name.trim().to_owned()));
        }
    }
}

/// A name is no input of the adjustment: the result stays current, and belongs to the renamed project.
pub(super) fn rename(document: &mut Document, name: String) {
    let current = document.current().cloned();
    document.project_mut().name = name;
    if let Some(result) = current {
        let input = document.project.clone();
        document.result = Some(Arc::new(document::AdjustmentResult { input, ..(*result).clone() }));
    }
}

fn content(document: &Document) -> Content {
    Content {
        project: (*document.project).clone(),
        targets: document.detections.iter().map(|(photo, d)| (photo.clone(), Detection::clone(d))).collect(),
        adjustment: document.current().map(|r| r.adjustment.clone()),
    }
}

/// Gives photos file names of their own: two cameras both have an IMG_0001.JPG, and a project file has one folder for all.
fn name_apart(project: &mut Project) {
    let mut taken = HashSet::new();
    for photo in &mut project.photos {
        let plain = photo.file.replace(['/', '\\', ':', '\0'], "_");
        let (stem, ending) = plain.rfind('.').map_or((plain.as_str(), ""), |dot| plain.split_at(dot));
        let mut name = plain.clone();
        let mut count = 1;
        while !taken.insert(name.clone()) {
            count += 1;
            name = format!("{stem} ({count}){ending}");
        }
        photo.file = name;
    }
}

/// A project's name as a file name.
pub(super) fn file_stem(name: &str) -> String {
    let safe = |c: char| if c.is_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '-' };
    let stem = name.trim().chars().map(safe).collect::<String>();
    if stem.is_empty() { "project".to_owned() } else { stem }
}

#[cfg(test)]
mod tests {
    use sightline::project::Photo;

    use super::*;

    #[test]
    fn photos_of_one_name_are_saved_under_names_of_their_own() {
        let named = |file: &str| Photo { file: file.into(), ..Photo::default() };
        let files = ["a.jpg", "b.jpg", "a.jpg", "a (2).jpg", "a.jpg", "c:d/e", "c_d_e"];
        let mut project = Project { photos: files.map(named).into(), ..Project::default() };
        name_apart(&mut project);
        let names = project.photos.iter().map(|photo| photo.file.as_str()).collect::<Vec<_>>();
        assert_eq!(names, ["a.jpg", "b.jpg", "a (2).jpg", "a (2) (2).jpg", "a (3).jpg", "c_d_e", "c_d_e (2)"]);
    }

    #[test]
    fn project_names_become_file_names() {
        assert_eq!(file_stem("Panel 043/b"), "Panel-043-b");
        assert_eq!(file_stem("패널 1"), "패널-1");
        assert_eq!(file_stem(" "), "project");
        assert!(is_project("a.b.SIGHTLINE") && !is_project("zip") && is_text("markpts.TXT"));
    }
}
