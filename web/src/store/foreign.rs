//! Files of other programs: a worker sorts and reads them; a network opens as a project, cameras are kept as equipment, and the rest goes
//! where it belongs. Files for other programs are prepared first, with what the conversion leaves, and handed over when asked for.

use std::collections::BTreeMap;
use std::rc::Rc;

use leptos::prelude::*;
use sightline::Error;
use sightline::equipment::Equipment;
use sightline::project::{Camera, Origin, Photo, Project};
use sightline_exchange::cameras::known;
use sightline_exchange::conversion::Covariance;
use sightline_exchange::foreign::CameraOptions;
use sightline_exchange::reason::ExchangeReason;
use sightline_protocol::{Content, Foreign, ForeignCameras, ReadForeign, WriteCamera, WriteNetwork, Written};

use super::background::Stop;
use super::intake::problem_sentence;
use super::pool::{Failure, TaskOutcome};
use super::saving::{file_stem, is_project, is_text};
use super::{Asking, Desk, JobKind, Problem, Reason, Step, Until};
use crate::browser::file::NamedFile;
use crate::browser::page;
use crate::browser::worker::Bytes;
use crate::edit::exchange::{measured_region, parameter_covariance};
use crate::i18n::{Text, background, errors, interchange as words};

/// Files that were asked for, by where they stand on the page.
pub type PreparedFiles = BTreeMap<String, Prepared>;

/// How far files are that were asked for.
#[derive(Clone)]
pub enum Prepared {
    /// A worker writes them.
    Waiting,
    /// They can be handed over.
    Ready(Written, Vec<Bytes>),
    /// They cannot be written.
    Refused(Error),
}

/// A file for another program.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// A camera of the project, in a format.
    Camera(String, String),
    /// The network, in a format.
    Network(String),
}

impl Wanted {
    /// By which it is found again.
    pub fn key(&self) -> String {
        match self {
            Self::Camera(camera, format) => format!("camera {format} {camera}"),
            Self::Network(format) => format!("network {format}"),
        }
    }
}

/// Whether a file is a picture by its name; all other files are recognised by what is in them.
pub(super) fn is_picture(name: &str) -> bool {
    const ENDINGS: [&str; 25] = [
        "jpg", "jpeg", "jpe", "png", "tif", "tiff", "bmp", "gif", "webp", "avif", "heic", "heif", "dng", "nef", "nrw",
        "cr2", "cr3", "arw", "orf", "rw2", "raf", "pef", "srw", "raw", "3fr",
    ];
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    ENDINGS.contains(&ending.as_str())
}

/// Whether an error only asks whether a difference between camera models is accepted.
pub fn asks_to_convert(error: &Error) -> bool {
    matches!(ExchangeReason::of_error(error), Some(ExchangeReason::ConversionTooLarge { .. }))
}

/// Signals of files from and for other programs.
#[derive(Clone, Copy, Default)]
pub struct OtherPrograms {
    /// Files for other programs.
    pub prepared: RwSignal<PreparedFiles, LocalStorage>,
    /// Pictures and lists that came together with a network whose opening waits for an answer.
    pub(super) following: StoredValue<(Vec<NamedFile>, Vec<NamedFile>), LocalStorage>,
}

impl Desk {
    /// Has files sorted by content; `pictures` came along and are taken afterwards.
    pub(super) fn take_by_content(self, files: Vec<NamedFile>, pictures: Vec<NamedFile>) {
        self.read_foreign(files, false, move |all, files| {
            self.take_others(all, files, pictures.clone(), !all.networks.is_empty());
        });
    }

    /// Reads what is of another program; `then` has the rest, before a network opens.
    fn read_foreign(self, files: Vec<NamedFile>, convert: bool, rest: impl Fn(&Foreign, Vec<NamedFile>) + 'static) {
        let names = files.iter().map(|file| file.name.clone()).collect();
        let contents = files.iter().map(|file| file.content.clone()).collect();
        let sizes = self.document.with_untracked(|d| photo_sizes(&d.project));
        let batch = self.start_job(JobKind::Reading, 1, || {});
        let on_outcome = move |outcome: TaskOutcome<ReadForeign>| {
            self.end_job();
            let mut all = match outcome {
                TaskOutcome::Done(all, _) => all,
                TaskOutcome::Failed(failure) => return self.tell_failure(failure),
                TaskOutcome::Progress(nothing) => match nothing {},
            };
            let (asked, refused): (Vec<_>, Vec<_>) =
                all.refused.drain(..).partition(|e| !convert && asks_to_convert(e));
            self.keep_foreign_cameras(std::mem::take(&mut all.cameras));
            if all.networks.len() > 1 {
                let list = all.networks.drain(..).map(|network| source(&network)).collect::<Vec<_>>().join("; ");
                self.say(true, Until::NextWork, move || words::several_networks(&list));
            }
            let network = all.networks.first().cloned();
            rest(&all, files.clone());
            if let Some(network) = network {
                self.open_network(network);
            }
            self.tell_refused(refused);
            if !asked.is_empty() {
                self.ask_to_convert(asked, files.clone());
            }
        };
        self.tasks
            .pool
            .with_value(|pool| pool.submit(batch, ReadForeign { names, sizes, convert }, contents, on_outcome));
    }

    /// Takes what is of no other program: lists and tables, documents, pictures.
    fn take_others(self, all: &Foreign, files: Vec<NamedFile>, mut pictures: Vec<NamedFile>, opens: bool) {
        let (mut texts, mut projects) = (Vec::new(), Vec::new());
        for file in files.into_iter().filter(|file| all.others.contains(&file.name)) {
            match () {
                () if is_project(&file.name) => projects.push(file),
                () if is_text(&file.name) || all.lists.contains(&file.name) => texts.push(file),
                () => pictures.push(file),
            }
        }
        match projects.pop() {
            Some(project) if !opens => return self.open_project_or_equipment(project),
            Some(project) => self.tell_problems(vec![Problem { file: project.name, reason: Reason::AnotherProject }]),
            None => {}
        }
        if opens {
            // They belong to the network, which comes first.
            self.other_programs.following.set_value((pictures, texts));
        } else if pictures.is_empty() {
            self.take_texts(texts, false);
        } else {
            self.take_photos(pictures, texts);
        }
    }

    /// Opens a network as a new project, with the pictures and lists that came along.
    fn open_network(self, project: Project) {
        let (pictures, texts) = self.other_programs.following.try_update_value(std::mem::take).unwrap_or_default();
        self.over_unsaved(move || {
            let stem = source(&project);
            let content = Content { project: project.clone(), targets: BTreeMap::default(), adjustment: None };
            self.take_content(content, &stem, Vec::new());
            match pictures.is_empty() {
                true => self.take_texts(texts.clone(), true),
                false => self.take_photos(pictures.clone(), texts.clone()),
            }
        });
    }

    /// Keeps cameras that were read, and goes where they are seen.
    fn keep_foreign_cameras(self, read: Vec<ForeignCameras>) {
        if read.is_empty() {
            return;
        }
        let files = read.iter().flat_map(|group| group.origin.files.clone()).collect::<Vec<_>>().join(", ");
        let today = page::today();
        let of = |group: &ForeignCameras| {
            let camera = |imported| known(imported, &group.origin, &today);
            group.cameras.iter().map(camera).collect::<Vec<_>>()
        };
        let cameras: Vec<_> = read.iter().flat_map(of).collect();
        let count = cameras.len();
        let sizes: Vec<_> = cameras.iter().map(|camera| [camera.width, camera.height]).collect();
        self.change_equipment(|all| {
            all.join(Equipment { cameras, ..Equipment::default() });
        });
        self.go(Step::Equipment);
        let fits = self.document.with_untracked(|d| {
            let fits = |camera: &Camera| sizes.contains(&[camera.width, camera.height]);
            d.project.cameras.is_empty() || d.project.cameras.iter().any(fits)
        });
        let different = sizes.iter().copied().collect::<std::collections::BTreeSet<_>>();
        let size = different.iter().map(|[width, height]| format!("{width} × {height}")).collect::<Vec<_>>().join(", ");
        self.say(!fits, Until::NextWork, move || {
            let kept = words::cameras_read(count, &files);
            if fits { kept } else { format!("{kept} {}", words::no_camera_fits(&size)) }
        });
    }

    /// Lists files that could not be read, where such a list is in sight, else reports it.
    fn tell_refused(self, refused: Vec<Error>) {
        let named = |error: Error| {
            let file = error.place().file.unwrap_or_default();
            Problem { file, reason: Reason::Engine(error) }
        };
        self.tell_problems(refused.into_iter().map(named).collect());
    }

    /// Files that were not taken: in the list of the step, or, where the step has none, as a notice.
    pub(super) fn tell_problems(self, new: Vec<Problem>) {
        if new.is_empty() {
            return;
        }
        self.add_problems(new.clone());
        if matches!(self.step.get_untracked(), Step::Start | Step::Photos) {
            return;
        }
        self.say(true, Until::NextWork, move || {
            let sentence = |problem: &Problem| match &problem.reason {
                // It has the file in its place.
                Reason::Engine(error) if error.place().file.is_some() => errors::sentence(error),
                reason => format!("{}: {}", problem.file, problem_sentence(reason)),
            };
            new.iter().map(sentence).collect::<Vec<_>>().join(" ")
        });
    }

    fn ask_to_convert(self, asked: Vec<Error>, files: Vec<NamedFile>) {
        let list = move || asked.iter().map(errors::sentence).collect::<Vec<_>>().join(" ");
        let convert: Rc<dyn Fn()> = Rc::new(move || self.read_foreign(files.clone(), true, |_, _| ()));
        let text = Rc::new(move || words::conversion_asked(list()));
        self.messages.asking.set(Some(Asking { text, choices: vec![(words::read_anyway as Text, convert)] }));
    }

    /// The camera that is written: its adjusted values with their covariance where there is a current result.
    pub fn outgoing_camera(self, id: &str) -> Option<(Camera, CameraOptions)> {
        self.document.with(|d| {
            let given = d.project.cameras.iter().find(|camera| camera.id == id)?;
            let adjusted = d.current().and_then(|result| {
                let own = |all: &&sightline::adjustment::AdjustedCamera| all.camera.id == id && all.photo.is_none();
                result.adjustment.cameras.iter().find(own)
            });
            let covariance: Option<Covariance> = adjusted.and_then(parameter_covariance);
            let camera = adjusted.map_or(given, |adjusted| &adjusted.camera).clone();
            let region = measured_region(&d.project, id);
            Some((camera, CameraOptions { covariance, region, convert: false }))
        })
    }

    /// Prepares files for another program; `convert` accepts a difference of more than 1 px.
    pub fn prepare(self, wanted: &Wanted, convert: bool) {
        let key = wanted.key();
        self.other_programs.prepared.update(|all| drop(all.insert(key.clone(), Prepared::Waiting)));
        let document = self.document.get_untracked();
        let set = move |key: &str, outcome: Result<(Written, Vec<Bytes>), Failure>| match outcome {
            // Files of a document that has changed since are not handed over.
            _ if !self.document.with_untracked(|d| d.same(&document)) => {}
            Ok((written, bytes)) => {
                self.other_programs
                    .prepared
                    .update(|all| drop(all.insert(key.to_owned(), Prepared::Ready(written, bytes))));
            }
            Err(Failure::Refused(error)) => {
                self.other_programs.prepared.update(|all| drop(all.insert(key.to_owned(), Prepared::Refused(error))));
            }
            Err(failure) => {
                self.other_programs.prepared.update(|all| drop(all.remove(key)));
                self.tell_failure(failure);
            }
        };
        let here = key.clone();
        let stop = Stop(background::file, move || self.other_programs.prepared.update(|all| drop(all.remove(&here))));
        match wanted {
            Wanted::Camera(camera, format) => {
                let Some((camera, options)) = untrack(|| self.outgoing_camera(camera)) else { return };
                let options = CameraOptions { convert, ..options };
                let task = WriteCamera { format: format.clone(), camera, options };
                self.ask(stop, task, Vec::new(), move |outcome| match outcome {
                    TaskOutcome::Done(written, bytes) => set(&key, Ok((written, bytes))),
                    TaskOutcome::Failed(failure) => set(&key, Err(failure)),
                    TaskOutcome::Progress(nothing) => match nothing {},
                });
            }
            Wanted::Network(format) => {
                let task = self.document.with_untracked(|d| WriteNetwork {
                    format: format.clone(),
                    project: (*d.project).clone(),
                    adjustment: d.current().map(|result| result.adjustment.clone()),
                    convert,
                });
                self.ask(stop, task, Vec::new(), move |outcome| match outcome {
                    TaskOutcome::Done(written, bytes) => set(&key, Ok((written, bytes))),
                    TaskOutcome::Failed(failure) => set(&key, Err(failure)),
                    TaskOutcome::Progress(nothing) => match nothing {},
                });
            }
        }
    }

    /// Hands over files that were prepared.
    pub fn hand_over_prepared(self, wanted: &Wanted) {
        let stem = file_stem(&self.document.with_untracked(|d| d.project.name.clone()));
        let stem = match wanted {
            Wanted::Camera(camera, _) => format!("{stem}-{}", file_stem(camera)),
            Wanted::Network(_) => stem,
        };
        self.other_programs.prepared.with_untracked(|all| {
            let Some(Prepared::Ready(written, bytes)) = all.get(&wanted.key()) else { return };
            for (name, bytes) in written.names.iter().zip(bytes) {
                let kind = if name.ends_with(".zip") { "application/zip" } else { "application/octet-stream" };
                self.hand_over(&format!("{stem}-{name}"), kind, bytes);
            }
        });
    }
}

/// Width and height of a project's photos by their files.
fn photo_sizes(project: &Project) -> BTreeMap<String, [u32; 2]> {
    let size = |photo: &Photo| {
        let camera = project.cameras.iter().find(|camera| camera.id == photo.camera)?;
        Some((photo.file.clone(), [camera.width, camera.height]))
    };
    project.photos.iter().filter(|photo| !photo.file.is_empty()).filter_map(size).collect()
}

/// Name of a network without one: its file without ending, or its format if there are several files.
fn source(project: &Project) -> String {
    if !project.name.is_empty() {
        return project.name.clone();
    }
    match project.origin.as_deref() {
        Some(Origin { files, .. }) if files.len() == 1 => {
            let file = files[0].rsplit(['/', '\\']).next().unwrap_or_default();
            file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned()
        }
        Some(origin) => format_name(&origin.format).to_owned(),
        None => String::new(),
    }
}

/// The name of a format for people.
pub fn format_name(format: &str) -> &str {
    match format {
        "opencv" => "OpenCV",
        "ros" => "ROS",
        "kalibr" => "Kalibr",
        "colmap" => "COLMAP",
        "metashape" => "Metashape",
        "agisoft-lens" => "Agisoft Lens",
        "micmac" => "MicMac",
        "bal" => "BAL",
        "bundler" => "Bundler",
        "meshroom" => "Meshroom",
        "nvm" => "VisualSFM",
        "opensfm" => "OpenSfM",
        "pix4d" => "Pix4D",
        "realitycapture" => "RealityCapture",
        "vstars" => "V-STARS",
        "photomodeler" => "PhotoModeler",
        "dbat" => "DBAT",
        other => other,
    }
}
