//! Incoming files: workers read the photos, and unusable files are listed while the others are processed.

mod state;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::exif::PhotoInfo;
use sightline::project::{Photo, Project};
use sightline_protocol::{Glance, Open};

use super::foreign::is_picture;
use super::pool::{Batch, Failure, TaskOutcome};
use super::saving::{is_packed, is_project, is_text};
use super::{Asking, Desk, JobKind, PhotoFile, Step, Until};
use crate::browser::file::NamedFile;
use crate::browser::page;
use crate::browser::picture::Picture;
use crate::document::{Change, Document};
use crate::edit::attaching::{self, Arriving, Belongs};
use crate::edit::cameras::{self, Signature};
use crate::edit::{naming, natural, pairs};
use crate::i18n::{Text, first, name_list, text};
use crate::parts::{Absent, part};
pub use state::{Coming, Intake, Problem, Reason, problem_sentence};

/// Longest side of the small pictures, sharp on twice as dense screens.
pub const SMALL_SIDE: u32 = 320;

type ReadPhotos = Rc<RefCell<Vec<(usize, Result<PhotoFile, Problem>)>>>;

part! { steps, fn sorted_and_taken(desk: Desk, files: Vec<NamedFile>) -> (), {
    desk.take_now(files);
} }

impl Desk {
    /// Takes files that a person drops or chooses: photos on the start page begin a project of their own.
    pub fn take_dropped(self, files: Vec<NamedFile>) {
        self.stop_what_runs_by_itself();
        let busy = self.tasks.job.with_untracked(Option::is_some);
        let begins = !busy
            && self.step.get_untracked() == Step::Start
            && !self.document.with_untracked(Document::is_empty)
            && files.iter().any(|file| is_picture(&file.name))
            && !files.iter().any(|file| is_project(&file.name));
        if !begins {
            return self.take(files);
        }
        self.over_unsaved(move || {
            self.begin_with(Document::default());
            self.take(files.clone());
        });
    }

    /// Takes files wherever they come from.
    pub fn take(self, files: Vec<NamedFile>) {
        self.when_it_came(sorted_and_taken(self, files));
    }

    /// Does what a part of the page does, which may be on its way; if it cannot be loaded, that is reported.
    pub(super) fn when_it_came(self, work: impl Future<Output = Result<(), Absent>> + 'static) {
        spawn_local(async move {
            if work.await.is_err() {
                self.say(true, Until::NextWork, || text::part_did_not_come().to_owned());
                self.look_for_another_build();
            }
        });
    }

    fn take_now(self, files: Vec<NamedFile>) {
        if files.is_empty() || !self.may_change() {
            return;
        }
        if self.step.get_untracked() == Step::Monitoring
            && files.iter().all(|f| is_project(&f.name) || is_text(&f.name))
        {
            self.take_epochs(files);
            return;
        }
        if self.tasks.job.with_untracked(Option::is_some) {
            self.say(true, Until::WorkEnds, || text::busy().to_owned());
            return;
        }
        let (mut packed, others): (Vec<_>, Vec<_>) = files.into_iter().partition(|f| is_packed(&f.name));
        if let Some(project) = packed.pop() {
            self.open_project(project);
            return;
        }
        self.intake.problems.set(Vec::new());
        let empty_text = |f: &NamedFile| f.content.is_empty() && is_text(&f.name);
        let (empty, others): (Vec<_>, Vec<_>) = others.into_iter().partition(empty_text);
        // A model of COLMAP may have no points: its file is not missing then.
        let (parts, empty): (Vec<_>, Vec<_>) =
            empty.into_iter().partition(|f| f.name.eq_ignore_ascii_case("points3D.txt"));
        self.tell_problems(empty.into_iter().map(|f| Problem { file: f.name, reason: Reason::Empty }).collect());
        let (pictures, mut others): (Vec<_>, Vec<_>) = others.into_iter().partition(|f| is_picture(&f.name));
        others.extend(parts);
        match (pictures.is_empty(), others.is_empty()) {
            (true, true) => {}
            (false, true) => self.take_photos(pictures, Vec::new()),
            (_, false) => self.take_by_content(others, pictures),
        }
    }

    /// Lists files that were not taken.
    pub(super) fn add_problems(self, new: Vec<Problem>) {
        if new.is_empty() {
            return;
        }
        self.intake.problems.update(|problems| {
            problems.extend(new);
            problems.dedup();
        });
    }

    /// Takes photos, then the texts that came with them.
    pub(super) fn take_photos(self, mut files: Vec<NamedFile>, texts: Vec<NamedFile>) {
        files.sort_by(|a, b| natural(&a.name, &b.name));
        let taken = ReadPhotos::default();
        let keep = taken.clone();
        // As many pixels as a JPEG has at most in so many bytes; a sensor's noise does not pack below a byte a pixel.
        let most = |file: &NamedFile| if pairs::is_raw(&file.name) { 1.0 } else { 3.0 } * file.content.size();
        let largest = files.iter().map(most).fold(2e6, f64::max);
        self.tasks.pool.with_value(|pool| pool.expect_pixels(largest));
        let batch = self.start_job(JobKind::Opening, files.len(), move || self.add_photos(&keep));
        self.glance_at(batch, &files);
        for (place, file) in files.into_iter().enumerate() {
            let (taken, texts) = (taken.clone(), texts.clone());
            let content = file.content.clone();
            let on_outcome = move |outcome: TaskOutcome<Open>| {
                let (file, taken, texts) = (file.clone(), taken.clone(), texts.clone());
                spawn_local(async move {
                    let result = look_into(file, outcome).await;
                    taken.borrow_mut().push((place, result));
                    if self.step_job(batch) {
                        self.end_job();
                        self.add_photos(&taken);
                        self.take_texts(texts, true);
                    }
                });
            };
            self.tasks.pool.with_value(|pool| {
                pool.submit(batch, Open { max_side: SMALL_SIDE }, vec![content], on_outcome);
            });
        }
    }

    /// Shows the embedded previews, before any of them is read whole.
    fn glance_at(self, batch: Batch, files: &[NamedFile]) {
        let coming = |file: &NamedFile| Coming { name: file.name.clone(), picture: None };
        self.intake.coming.set(files.iter().map(coming).collect());
        for (place, file) in files.iter().enumerate() {
            let on_outcome = move |outcome: TaskOutcome<Glance>| {
                // Where nothing is found the photo's own picture comes when it is read.
                let TaskOutcome::Done(Some(found), bytes) = outcome else { return };
                let Some(bytes) = bytes.into_iter().next() else { return };
                spawn_local(async move {
                    let Ok(picture) = Picture::from_rgba(bytes, found.small[0], found.small[1]).await else { return };
                    if !self.tasks.job.with_untracked(|job| job.as_ref().is_some_and(|job| job.batch == batch)) {
                        return;
                    }
                    self.intake.coming.update(|all| {
                        if let Some(coming) = all.get_mut(place) {
                            coming.picture = Some((picture, found.orientation));
                        }
                    });
                    if self.step.get_untracked() == Step::Start {
                        self.go(Step::Photos);
                    }
                });
            };
            let task = Glance { max_side: SMALL_SIDE };
            self.tasks.pool.with_value(|pool| pool.submit(batch, task, vec![file.content.clone()], on_outcome));
        }
    }

    /// Adds what was looked into, in the order of the file names, as one change.
    fn add_photos(self, taken: &ReadPhotos) {
        self.intake.coming.set(Vec::new());
        let mut all = taken.take();
        all.sort_by_key(|(place, _)| *place);
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        let (mut added, mut recorded) = (0, 0);
        let mut asked = Vec::new();
        let mut problems = self.intake.problems.get_untracked();
        let raws: Vec<(String, PhotoInfo)> = all
            .iter()
            .filter_map(|(_, result)| result.as_ref().ok())
            .filter(|file| pairs::is_raw(&file.name))
            .map(|file| (file.name.clone(), file.info.clone()))
            .collect();
        for (_, result) in all {
            let file = match result {
                Ok(file) => file,
                Err(problem) => {
                    problems.push(problem);
                    continue;
                }
            };
            let known = self.photos.files.with_untracked(|files| {
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
            let id = match self.belongs(&file) {
                Belongs::To(id) => {
                    recorded += usize::from(attaching::record(&mut project, &id, &file.sha256));
                    id
                }
                belongs @ (Belongs::Differs(_) | Belongs::Unrecorded(_)) => {
                    if asked.iter().any(|(_, other): &(Belongs, PhotoFile)| other.digest == file.digest) {
                        continue;
                    }
                    let of = match &belongs {
                        Belongs::Differs(id) | Belongs::Unrecorded(id) => id.clone(),
                        _ => String::new(),
                    };
                    problems.push(Problem { file: file.name.clone(), reason: Reason::SameName { of } });
                    asked.push((belongs, file));
                    continue;
                }
                Belongs::Nowhere => {
                    if let Some(reason) = self.other_of_the_shot(&project, &file, &raws) {
                        problems.push(Problem { file: file.name.clone(), reason });
                        self.photos.others.update_value(|others| {
                            others.retain(|other| other.digest != file.digest);
                            others.push(file);
                        });
                        continue;
                    }
                    added += 1;
                    self.add_photo(&mut project, &file)
                }
            };
            self.photos.files.update(|files| {
                files.insert(id, file);
            });
        }
        problems.dedup();
        self.intake.problems.set(problems);
        if added > 0 && project.name.is_empty() {
            project.name = self.name_of(&project);
        }
        if added > 0 {
            self.change(Change::PhotosAdded(added), |document| *document.project_mut() = project);
        } else if recorded > 0 {
            self.change(Change::PhotosAttached(recorded), |document| *document.project_mut() = project);
        }
        self.ask_whose(asked);
        self.document.with_untracked(|d| {
            if let Some(photo) =
                d.project.photos.first().filter(|_| self.selection.with_untracked(|s| s.photo.is_none()))
            {
                self.select_photo(&photo.id);
            }
        });
        // If no file could be used, the start page shows the reasons.
        let empty = self.document.with_untracked(|d| d.project.photos.is_empty());
        match self.step.get_untracked() {
            Step::Start if !empty => self.go(Step::Photos),
            Step::Photos if self.document.with_untracked(Document::is_empty) => self.go(Step::Start),
            _ => {}
        }
    }

    /// Which photo of an opened project this file belongs to.
    fn belongs(self, file: &PhotoFile) -> Belongs {
        self.photos.files.with_untracked(|files| {
            let waits = |photo: &Photo| !files.contains_key(&photo.id);
            let arriving = Arriving { name: &file.name, sha256: &file.sha256, size: file.size };
            self.document.with_untracked(|d| attaching::belongs(d, &waits, arriving))
        })
    }

    /// Asks what files are that have the names of photos, where their contents differ or nothing recorded tells. Until it is answered
    /// they are listed as not taken, and no photo is touched.
    fn ask_whose(self, asked: Vec<(Belongs, PhotoFile)>) {
        if asked.is_empty() {
            return;
        }
        let names = asked.iter().map(|(_, file)| file.name.clone()).collect::<Vec<_>>();
        let count = names.len();
        // One that differs for certain makes the whole drop doubtful, and so do two files for one photo.
        let differs = asked.iter().enumerate().any(|(k, (belongs, _))| {
            matches!(belongs, Belongs::Differs(_)) || asked[..k].iter().any(|(other, _)| other == belongs)
        });
        let files: Rc<Vec<(String, PhotoFile)>> = Rc::new(
            asked
                .into_iter()
                .filter_map(|(belongs, file)| match belongs {
                    Belongs::Differs(id) | Belongs::Unrecorded(id) => Some((id, file)),
                    Belongs::To(_) | Belongs::Nowhere => None,
                })
                .collect(),
        );
        let choice = |words: Text, verb: fn(Self, &[(String, PhotoFile)])| {
            let files = files.clone();
            let take: Rc<dyn Fn()> = Rc::new(move || {
                if !self.may_change() {
                    return;
                }
                let listed = |problem: &Problem| {
                    matches!(problem.reason, Reason::SameName { .. }) && names_of(&files).contains(&problem.file)
                };
                self.intake.problems.update(|problems| problems.retain(|problem| !listed(problem)));
                verb(self, &files);
            });
            (words, take)
        };
        let mut choices =
            vec![choice(text::add_as_new, Self::add_as_new), choice(text::replace_photos, Self::replace_photos)];
        if !differs {
            choices.insert(0, choice(text::same_photos, Self::attach_as_same));
        }
        let text = Rc::new(move || match differs {
            true => text::photos_differ(count, name_list(&names)),
            false => text::photos_unrecorded(count, name_list(&names)),
        });
        self.messages.asking.set(Some(Asking { text, choices }));
    }

    /// Adds files as photos of their own.
    fn add_as_new(self, files: &[(String, PhotoFile)]) {
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        for (_, file) in files {
            let id = self.add_photo(&mut project, file);
            self.photos.files.update(|all| {
                all.insert(id, file.clone());
            });
        }
        self.change(Change::PhotosAdded(files.len()), |document| *document.project_mut() = project);
    }

    /// Puts files in the place of photos, which go with all that was measured in them. The new ones have identifiers of their own, so that
    /// undo brings back photos that wait for their own files.
    fn replace_photos(self, files: &[(String, PhotoFile)]) {
        let mut after = self.document.get_untracked();
        let mut last = None;
        for (old, file) in files {
            let id = self.add_photo(after.project_mut(), file);
            attaching::replace(&mut after, old);
            self.photos.files.update(|all| {
                all.insert(id.clone(), file.clone());
            });
            last = Some(id);
        }
        self.change(Change::PhotosReplaced(files.len()), |document| *document = after);
        if let Some(id) = last {
            self.select_photo(&id);
        }
    }

    /// Attaches files to the photos of their names, and records their contents.
    fn attach_as_same(self, files: &[(String, PhotoFile)]) {
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        for (id, file) in files {
            attaching::record(&mut project, id, &file.sha256);
        }
        self.change(Change::PhotosAttached(files.len()), |document| *document.project_mut() = project);
        self.photos.files.update(|all| all.extend(files.iter().cloned()));
    }

    /// Another file of the same exposure: a photo of the project, or for a developed one its RAW among those that come with it.
    fn other_of_the_shot(self, project: &Project, file: &PhotoFile, raws: &[(String, PhotoInfo)]) -> Option<Reason> {
        let raw = pairs::is_raw(&file.name);
        let same = |name: &str, info: &PhotoInfo| pairs::same_shot((&file.name, &file.info), (name, info));
        let known = self.photos.files.with_untracked(|files| {
            let info = |photo: &Photo| files.get(&photo.id).map(|file| file.info.clone()).unwrap_or_default();
            project.photos.iter().find(|photo| same(&photo.file, &info(photo))).map(|photo| photo.file.clone())
        });
        let coming = || raws.iter().find(|(name, info)| same(name, info)).map(|(name, _)| name.clone());
        match (known, raw) {
            (Some(of), true) => Some(Reason::RawOf { of }),
            (Some(of), false) => Some(Reason::Developed { of }),
            (None, true) => None,
            (None, false) => coming().map(|of| Reason::Developed { of }),
        }
    }

    /// Measures the other file of every shot that is here twice, RAW in place of what was developed from it or the other way round, as
    /// one change: the photos are new ones, since nothing that was measured in the one holds in the other.
    pub fn swap_shots(self) {
        if !self.may_change() {
            return;
        }
        let others = self.photos.others.get_value();
        let mut swapped: Vec<(String, PhotoFile)> = Vec::new();
        let mut left = Vec::new();
        for other in others {
            let of_the_shot = self.photos.files.with_untracked(|files| {
                self.document.with_untracked(|d| {
                    let same = |photo: &&Photo| {
                        let info = files.get(&photo.id).map(|file| file.info.clone()).unwrap_or_default();
                        pairs::same_shot((&other.name, &other.info), (&photo.file, &info))
                    };
                    d.project.photos.iter().find(same).map(|photo| photo.id.clone())
                })
            });
            // Of three files of a shot still one is measured.
            match of_the_shot.filter(|id| !swapped.iter().any(|(taken, _)| taken == id)) {
                Some(id) => swapped.push((id, other)),
                None => left.push(other),
            }
        }
        if swapped.is_empty() {
            return;
        }
        let replaced: BTreeSet<String> = swapped.iter().map(|(id, _)| id.clone()).collect();
        let before: Vec<PhotoFile> =
            self.photos.files.with_untracked(|files| replaced.iter().filter_map(|id| files.get(id).cloned()).collect());
        let mut project = self.document.with_untracked(|d| (*d.project).clone());
        let mut problems: Vec<Problem> = self.intake.problems.get_untracked();
        let mut fresh = Vec::new();
        for (old, file) in &swapped {
            let id = self.add_photo(&mut project, file);
            // In the place of the one that it replaces.
            if let (Some(new), Some(place)) =
                (project.photos.pop(), project.photos.iter().position(|photo| photo.id == *old))
            {
                project.photos.insert(place, new);
            }
            problems.retain(|problem| problem.file != file.name);
            let of = file.name.clone();
            if let Some(other) = before.iter().find(|b| pairs::same_shot((&file.name, &file.info), (&b.name, &b.info)))
            {
                let reason = if pairs::is_raw(&other.name) { Reason::RawOf { of } } else { Reason::Developed { of } };
                problems.push(Problem { file: other.name.clone(), reason });
            }
            fresh.push((id, file.clone()));
        }
        self.change(Change::ShotsSwapped(fresh.len()), |document| {
            *document.project_mut() = project;
            cameras::remove_photos(document, &replaced);
        });
        self.intake.problems.set(problems);
        // Those that are measured now too: undo makes them the others again.
        let mut others: Vec<PhotoFile> = left.into_iter().chain(before).collect();
        others.extend(fresh.iter().map(|(_, file)| file.clone()));
        self.photos.others.set_value(others);
        let first = fresh.first().map(|(id, _)| id.clone());
        self.photos.files.update(|files| files.extend(fresh));
        if let Some(first) = first {
            self.select_photo(&first);
        }
    }

    /// Files that were not taken. Of two files of a shot it is the one that is not measured in the project as it is: undo changes which.
    pub fn left_out(self) -> Vec<Problem> {
        let measured: BTreeSet<String> =
            self.document.with(|d| d.project.photos.iter().map(|photo| photo.file.clone()).collect());
        let now = |Problem { file, reason }: Problem| match reason {
            Reason::RawOf { of } if measured.contains(&file) && !measured.contains(&of) => {
                Problem { file: of, reason: Reason::Developed { of: file } }
            }
            Reason::Developed { of } if measured.contains(&file) && !measured.contains(&of) => {
                Problem { file: of, reason: Reason::RawOf { of: file } }
            }
            reason => Problem { file, reason },
        };
        self.intake.problems.get().into_iter().map(now).collect()
    }

    /// Name of a project from its photos.
    fn name_of(self, project: &Project) -> String {
        let none = PhotoInfo::default();
        let name = self.photos.files.with_untracked(|files| {
            let of = |photo| files.get(photo).map_or(&none, |file: &PhotoFile| &file.info);
            let photos = project.photos.iter().map(|p| (p.file.as_str(), of(&p.id))).collect::<Vec<_>>();
            naming::project_name(&photos, &page::today(), first::project())
        });
        self.name_apart(name)
    }

    fn add_photo(self, project: &mut Project, file: &PhotoFile) -> String {
        let signature = Signature::of(&file.name, &file.info, file.size);
        let shares = self.photos.files.with_untracked(|files| {
            let shares = |photo: &&Photo| {
                files.get(&photo.id).is_some_and(|f| Signature::of(&f.name, &f.info, f.size) == signature)
            };
            project.photos.iter().rev().find(shares).map(|photo| photo.id.clone())
        });
        let id = self.photos.files.with_untracked(|files| {
            let taken = |id: &str| files.get(id).is_some_and(|known| known.digest != file.digest);
            cameras::add_photo(project, &file.name, &file.info, file.size, shares.as_deref(), &taken)
        });
        if let Some(photo) = project.photos.iter_mut().find(|photo| photo.id == id) {
            photo.sha256.clone_from(&file.sha256);
        }
        id
    }
}

fn names_of(files: &[(String, PhotoFile)]) -> Vec<String> {
    files.iter().map(|(_, file)| file.name.clone()).collect()
}

async fn look_into(file: NamedFile, outcome: TaskOutcome<Open>) -> Result<PhotoFile, Problem> {
    let NamedFile { name, content } = file;
    let failed = |reason| Problem { file: name.clone(), reason };
    match outcome {
        TaskOutcome::Failed(Failure::Refused(_)) if content.is_empty() => Err(failed(Reason::Empty)),
        TaskOutcome::Done(opened, bytes) => {
            let bytes = bytes.into_iter().next().ok_or_else(|| failed(Reason::Unreadable(String::new())))?;
            let small = Picture::from_rgba(bytes, opened.small[0], opened.small[1]).await;
            let small = small.map_err(|detail| failed(Reason::Unreadable(detail)))?;
            Ok(PhotoFile {
                name,
                content,
                original: None,
                size: opened.size,
                info: opened.info,
                small,
                digest: opened.digest,
                sha256: opened.sha256,
            })
        }
        TaskOutcome::Failed(Failure::Refused(error)) => Err(failed(Reason::Engine(error))),
        TaskOutcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
            Err(failed(Reason::Unreadable(detail)))
        }
        TaskOutcome::Progress(nothing) => match nothing {},
    }
}
