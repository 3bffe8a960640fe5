//! The bundled sample: photos rendered and measured by the workers, then oriented, matched and adjusted.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::detection::Detection;
use sightline::project::Project;
use sightline_protocol::{Opened, Sample, SamplePhoto, SamplePhotoMade};

use super::intake::SMALL_SIDE;
use super::pool::TaskOutcome;
use super::{Desk, JobKind, PhotoFile, Selection, Step};
use crate::browser::file::Blob;
use crate::browser::page;
use crate::browser::picture::Picture;
use crate::browser::worker::Bytes;
use crate::edit::sample;
use crate::i18n::text;
use crate::parts::part;

type RenderedPhotos = Rc<RefCell<BTreeMap<String, (PhotoFile, Detection)>>>;

part! { steps, fn sample_planned(desk: Desk) -> (), {
    desk.plan_sample();
} }

impl Desk {
    /// Opens the sample project and adjusts it.
    pub fn open_sample(self) {
        self.over_unsaved(move || self.when_it_came(sample_planned(self)));
    }

    /// Has the sample's project made.
    fn plan_sample(self) {
        let batch = self.start_job(JobKind::Sample, 1, || {});
        let on_outcome = move |outcome: TaskOutcome<Sample>| match outcome {
            TaskOutcome::Done(project, _) => {
                self.end_job();
                self.make_sample(Rc::new(project));
            }
            TaskOutcome::Failed(failure) => {
                self.end_job();
                self.tell_failure(failure);
            }
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        self.tasks.pool.with_value(|pool| pool.submit(batch, Sample {}, Vec::new(), on_outcome));
    }

    /// Has the sample's photos rendered and measured.
    fn make_sample(self, project: Rc<Project>) {
        let made = RenderedPhotos::default();
        let (keep, kept) = (made.clone(), project.clone());
        let names = project.photos.iter().map(|photo| photo.file.clone()).collect::<Vec<_>>();
        let pixels = project.cameras.iter().map(|c| f64::from(c.width) * f64::from(c.height)).fold(0.0, f64::max);
        self.tasks.pool.with_value(|pool| pool.expect_pixels(pixels));
        let batch = self.start_job(JobKind::Sample, names.len(), move || self.put_sample(&kept, &keep, |_| ()));
        for name in names {
            let (made, project) = (made.clone(), project.clone());
            let task = SamplePhoto { name: name.clone(), max_side: SMALL_SIDE };
            let on_outcome = move |outcome: TaskOutcome<SamplePhoto>| match outcome {
                TaskOutcome::Done(SamplePhotoMade { opened, detection }, bytes) => {
                    let (made, project, name) = (made.clone(), project.clone(), name.clone());
                    spawn_local(async move {
                        if let Some(file) = photo_file(name.clone(), opened, bytes).await {
                            made.borrow_mut().insert(name, (file, detection));
                        }
                        if self.step_job(batch) {
                            self.end_job();
                            self.put_sample(&project, &made, Self::match_then_adjust);
                        }
                    });
                }
                TaskOutcome::Failed(failure) => {
                    self.end_job();
                    self.tell_failure(failure);
                }
                TaskOutcome::Progress(nothing) => match nothing {},
            };
            self.tasks.pool.with_value(|pool| pool.submit(batch, task, Vec::new(), on_outcome));
        }
    }

    /// Puts the sample on the desk with the photos that are made, then goes on; each in a task of the page of its own, since each draws much.
    fn put_sample(self, project: &Project, made: &RenderedPhotos, then: fn(Self)) {
        let made = made.take();
        let of = |file: &str| made.get(file).map(|(file, detection)| (file.sha256.clone(), detection.clone()));
        let document = sample::document(project, text::sample_name(), of);
        let photos = &document.project.photos;
        let first = photos.first().map(|photo| photo.id.clone());
        let files = photos.iter().filter_map(|p| Some((p.id.clone(), made.get(&p.file)?.0.clone()))).collect();
        self.begin(document);
        self.forget_waiting();
        self.photos.files.set(files);
        self.selection.set(Selection { photo: first, ..Selection::default() });
        spawn_local(async move {
            page::breathe().await;
            self.go(Step::Targets);
            page::breathe().await;
            then(self);
        });
    }
}

async fn photo_file(name: String, opened: Opened, bytes: Vec<Bytes>) -> Option<PhotoFile> {
    let mut bytes = bytes.into_iter();
    let (photo, small) = (bytes.next()?, bytes.next()?);
    let small = Picture::from_rgba(small, opened.small[0], opened.small[1]).await.ok()?;
    let content = Blob::from_bytes(&photo).ok()?;
    Some(PhotoFile {
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
