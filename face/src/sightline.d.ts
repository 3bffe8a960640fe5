/** Name of a parameter of the interior orientation; "f" stands for fx = fy. */
export type Parameter = "c" | "x0" | "y0" | "k1" | "k2" | "k3" | "p1" | "p2" | "b1" | "b2" | "f" | "fx" | "fy" | "cx" | "cy" | "k4" | "k5" | "k6";

/** Interior orientation: a correction added to the measured photo coordinates. Lengths in photo units (mm with a pixel pitch, else pixels). */
export interface BrownInterior {
  model: "brown";
  /** Principal distance; null: not known yet. */
  c?: number | null;
  x0?: number;
  y0?: number;
  k1?: number;
  k2?: number;
  k3?: number;
  p1?: number;
  p2?: number;
  b1?: number;
  b2?: number;
}

/** Interior orientation: ideal to image on normalised coordinates; fx, fy, cx, cy in the pixel frame (OpenCV's cx is ours - 0.5). */
export interface OpencvInterior {
  model: "opencv";
  /** Focal lengths in pixels; null: not known yet. */
  fx?: number | null;
  fy?: number | null;
  cx: number;
  cy: number;
  k1?: number;
  k2?: number;
  p1?: number;
  p2?: number;
  k3?: number;
}

/** The same with a rational radial distortion, OpenCV's eight coefficients: (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶). */
export interface OpencvRationalInterior extends Omit<OpencvInterior, "model"> {
  model: "opencv_rational";
  k4?: number;
  k5?: number;
  k6?: number;
}

/**
 * OpenCV's fisheye (equidistant; Kannala and Brandt 2006): the angle off the axis is distorted, θd = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸). Rays of
 * more than 90 degrees off the axis have an image.
 */
export interface OpencvFisheyeInterior {
  model: "opencv_fisheye";
  /** Focal lengths in pixels; null: not known yet. */
  fx?: number | null;
  fy?: number | null;
  cx: number;
  cy: number;
  k1?: number;
  k2?: number;
  k3?: number;
  k4?: number;
}

export type Interior = BrownInterior | OpencvInterior | OpencvRationalInterior | OpencvFisheyeInterior;

interface CameraBase {
  id: string | number;
  /** Sensor grid in pixels. */
  width: number;
  height: number;
  /** Size of a pixel in millimetres; null: photo coordinates are in pixels. */
  pixel_pitch?: [number, number] | null;
  /** Parameters to be estimated. */
  free?: Parameter[];
  /** Parameters observed with an a priori standard error; these are estimated too. */
  sigma?: Partial<Record<Parameter, number>>;
  /** Whether every photo has its own interior orientation. */
  per_photo?: boolean;
}

export type Camera = CameraBase & Interior;

export interface Photo {
  id: string | number;
  camera: string | number;
  file?: string;
  /** Projection centre in the object system. */
  position?: [number, number, number] | null;
  /** Omega, phi, kappa in radians. */
  rotation?: [number, number, number] | null;
  enabled?: boolean;
  /** Standard errors of a given projection centre. */
  sigma_position?: [number | null, number | null, number | null] | null;
  /** The photo's own interior orientation, for a camera with per_photo. */
  interior?: Interior | null;
  /** SHA-256 of the file in hexadecimal digits, if known. */
  sha256?: string;
}

export interface Point {
  id: string | number;
  role?: "tie" | "control" | "check";
  /** Given (control, check) or initial (tie). */
  xyz?: [number, number, number] | null;
  /** Standard errors of given coordinates; null or 0 fixes that axis of a control point. */
  sigma?: [number | null, number | null, number | null] | null;
  /** Diameter of the circular target in the object's unit. */
  diameter?: number | null;
  /**
   * Normal of the target's plane in the object system, of any length and either sign; null: estimated from neighbouring points.
   * Used only with a diameter.
   */
  normal?: [number, number, number] | null;
}

/** A point measured in a photo, in pixels. */
export interface Observation {
  photo: string | number;
  point: string | number;
  u: number;
  v: number;
  sigma: number | [number, number];
  enabled?: boolean;
  /** Number of the target in the photo whose centre was measured. */
  target?: number | null;
}

export interface Distance {
  from: string | number;
  to: string | number;
  length: number;
  sigma: number;
  /** Compared only, not used in the adjustment [false]. */
  check?: boolean;
}

/** A section of the report. */
export type ReportSection =
  | "summary" | "uncertainty" | "observations" | "cameras" | "network" | "photos" | "points" | "control" | "lengths" | "statistics" | "residuals"
  | "gross_errors" | "features" | "settings" | "all_observations";

/** Contents and layout of the report; not an input of the adjustment. */
export interface ReportSettings {
  /** [the project's name] */
  title?: string;
  operator?: string;
  date?: string;
  text?: string;
  /** A data: URL of a PNG or JPEG file. */
  logo?: string;
  /** ["en"] */
  language?: "en" | "ko" | null;
  /** ["a4"] */
  paper?: "a4" | "letter";
  /** [["all_observations"]] */
  left_out?: ReportSection[];
  /** Coverage factor of expanded uncertainties [2]. */
  coverage_factor?: number;
  /** Maximum permitted length measurement error: constant + length / per, in the project's unit. */
  length_limit?: { constant: number; per?: number | null } | null;
}

export interface Datum {
  kind: "control" | "minimal" | "free";
  points?: (string | number)[] | null;
}

/** Cameras on one mount that release together: one relative pose each to the first one, the same at every exposure up to these sigmas. */
export interface Rig {
  /** A row an exposure, a column a camera: the photos taken together, null if a camera took none. */
  exposures: (string | null)[][];
  /** Standard error of the relative position per axis, in the project's unit; greater than 0. */
  sigma_position: number;
  /** Standard error of the relative rotation per axis, radians; at least 1e-8. */
  sigma_rotation: number;
}

/** The document. Optional fields may be left out; documents returned by the engine have all fields. */
export interface Project {
  format: "sightline";
  version: 1;
  name?: string;
  unit?: string;
  /**
   * Letters and order in which coordinates are shown and written for people: "enh" as E, N, H, "neh" as N, E, H; absent or null: X, Y, Z. Triples of the document and
   * of results stay X (east), Y (north), Z in any case, and so do drawings and files of other programs.
   */
  axes?: "enh" | "neh" | null;
  cameras?: Camera[];
  photos?: Photo[];
  points?: Point[];
  observations?: Observation[];
  distances?: Distance[];
  datum?: Datum;
  /** Cameras fixed to each other. */
  rig?: Rig;
  /** Observations disabled by the last orientation, with the reason; the next orientation tests them again. */
  set_aside?: {
    photo: string;
    point: string;
    /** undecided: the point has two positions with equally many observations. */
    reason: "disagrees" | "photo_not_oriented" | "point_not_determined" | "undecided";
    /** Distance from the predicted position. */
    distance_px?: number | null;
    /** ["orientation"] */
    by?: "orientation" | "matching";
  }[];
  /** Features measured on every result of this document. */
  features?: Feature[];
  /** Coordinate systems computed for every result. */
  systems?: CoordinateSystem[];
  /** Lines between points, for drawings. */
  lines?: { from: string | number; to: string | number; layer?: string }[];
  /** Layers of the lines; `colour` is red, green, blue, 0 to 255. */
  layers?: { id: string | number; colour: [number, number, number] }[];
  report?: ReportSettings;
  /** Plan made before the photos were taken. */
  plan?: Plan;
  /** The project of epoch 0, with the number of this epoch in the series. */
  epoch?: { name: string; key?: string; number: number; names?: Record<string, string> };
  /** Files of another program, or of an earlier version, that the project was read from. */
  origin?: Origin;
}

/** Files of another program, or of an earlier version (format "sightline"), that were read, with assumptions, ignored data and conversions. Not an input of the adjustment. */
export interface Origin {
  format: string;
  files?: string[];
  assumed?: Assumed[];
  ignored?: Ignored[];
  conversions?: Conversion[];
  /** The system that latitudes and longitudes of lists were converted into; give it as `local_system` to read further lists. */
  local_system?: LocalSystem;
}

/**
 * Local Cartesian system on the ellipsoid: X to the east, Y to the north, Z up at the origin, metres, through geocentric coordinates. Not a map
 * projection.
 */
export interface LocalSystem {
  /** Also for GRS80, which has the same axes to 0.1 mm. */
  ellipsoid?: "WGS84";
  /** Degrees, to the north positive. */
  latitude: number;
  /** Degrees, to the east positive. */
  longitude: number;
  /** Over the ellipsoid, metres. */
  height: number;
}

/** An end of a distance or a side of an angle. */
export type End = { point: string | number } | { feature: string | number };

/** A point with coordinates of another system; `sigma` gives its weight; leave it out for equal weights. */
export interface GivenPoint {
  id: string | number;
  xyz: [number, number, number];
  sigma?: [number, number, number] | null;
}

/**
 * A named feature. Forms are fitted by least squares of the orthogonal distances: a line needs 2 points, a plane or a circle 3, a sphere
 * 4, a cylinder 6. The distance of two planes is that of the second's centroid from the first; of a line and a plane, that of the line's
 * centroid; of lines parallel within 5°, that of the second's centroid. An angle has its vertex at `at` (0 to 180°), or lies between
 * directions of lines and axes and normals of planes and circles (0 to 90°). Deviations are from a form (positive outside, or on the side
 * of the normal) or from `given` coordinates of the same names.
 */
export type Feature = { id: string | number } & (
  | { kind: "line" | "plane" | "circle" | "sphere" | "cylinder"; points: (string | number)[] }
  | { kind: "distance"; from: End; to: End }
  | { kind: "angle"; from: End; at?: End | null; to: End }
  | { kind: "deviations"; points?: (string | number)[]; feature?: string | null; given?: GivenPoint[] }
);

/**
 * A named coordinate system. automatic: Z the normal of the points' plane towards the photos, X their longer extent, the origin their centroid.
 * plane_line_point (3-2-1): Z is 0 in the plane, Y on the line, X at the point. best_fit: weighted least squares fit to given coordinates.
 */
export type CoordinateSystem = { id: string | number } & (
  | { kind: "automatic"; points?: (string | number)[] }
  | { kind: "plane_line_point"; plane: (string | number)[]; line: (string | number)[]; point: string | number }
  | { kind: "best_fit"; given: GivenPoint[]; scale?: boolean }
);

/** A point's distance from a form, or its difference from given coordinates. */
export interface FeatureResidual {
  point: string;
  value: number;
  /** Standard error of a deviation. */
  sigma?: number;
  difference?: [number, number, number];
}

/** A feature measured on a result; sigmas are from the full covariance of the points, null without statistics. */
export interface MeasuredFeature {
  id: string;
  kind: "line" | "plane" | "circle" | "sphere" | "cylinder" | "distance" | "angle" | "deviations";
  /** Number of points used. */
  points: number;
  quantity: "distance" | "angle" | "diameter" | null;
  /** In the project's unit; angles in radians. */
  value: number | null;
  sigma: number | null;
  /** Centre of a circle or sphere, else the foot of the points' centroid. */
  position: [number, number, number] | null;
  sigma_position: [number, number, number] | null;
  direction: [number, number, number] | null;
  /** Largest standard error of the direction, radians. */
  sigma_direction: number | null;
  /** Rms of the distances from the form. */
  rms: number | null;
  /** Smallest and largest distance from the form. */
  range: [number, number] | null;
  residuals?: FeatureResidual[];
  /** Points to draw: ends of a distance, sides and vertex of an angle, ends of a line or an axis. */
  ends?: [number, number, number][];
  /** Present if the feature, or one it is measured from, is too weakly determined for standard errors: standard error of the radius
   * divided by the radius, or of the direction in radians. */
  weak?: number;
  /** Rms divided by the largest extent of the points, if above 0.02: the points do not form the feature. */
  misfit?: number;
  /** Its points that are not in this adjustment. */
  missing?: string[];
  /** Why there is no result. */
  error?: { code: string; [name: string]: unknown };
}

/** A coordinate system of a result: x' = scale * rotation * x + shift. */
export interface MeasuredSystem {
  id: string;
  rotation: [[number, number, number], [number, number, number], [number, number, number]];
  shift: [number, number, number];
  scale: number;
  /** Of a best fit. */
  redundancy?: number;
  /** Of a best fit with redundancy. */
  sigma0?: number;
  residuals?: FeatureResidual[];
  /** All adjusted points in this system. */
  points: { id: string; xyz: [number, number, number]; sigma?: [number, number, number] }[];
  missing?: string[];
  error?: { code: string; [name: string]: unknown };
}

/** Result of `measureFeatures`. */
export interface Measured {
  features: MeasuredFeature[];
  systems: MeasuredSystem[];
}

/** Points matched to given coordinates. */
export interface Renaming {
  /** Present name, given name, distance. */
  pairs: [string, string, number][];
  /** Given points with several candidates, or that share a candidate. */
  ambiguous: string[];
  not_found: string[];
}

export interface Iteration {
  sigma0: number;
  step: number;
  damping: number;
}

/** A sparse matrix by rows (compressed sparse rows); indices count from 0. */
export interface SparseMatrix {
  rows: number;
  columns: number;
  /** First entry of every row, and the number of entries. */
  row_starts: number[];
  column_indices: number[];
  values: number[];
}

/** An unknown: a column of A. */
export interface Unknown {
  name: string;
  kind: "rotation" | "projection_centre" | "interior_orientation" | "point";
  photo?: string;
  camera?: string;
  point?: string;
  /** Present value; 0 for rotations, which are counted from the present attitude about the camera axes. */
  value: number;
  unit: string;
  /** The engine's scaled matrix is A with its columns multiplied by this. */
  scale: number;
}

/** An observation: a row of A. */
export interface Equation {
  name: string;
  photo?: string;
  point?: string;
  /** Observations of other kinds than image coordinates. */
  given?: Given;
  axis?: "x" | "y" | "X" | "Y" | "Z";
  value: number;
  sigma: number;
  unit: string;
}

/** Linearised observation equations v = A d - l; corrections d = (A'PA)^-1 A'Pl, without control under the constraints D d = 0. */
export interface LinearSystem {
  unknowns: Unknown[];
  observations: Equation[];
  A: SparseMatrix;
  /** Observed minus computed, in the unit of the observation. */
  l: number[];
  /** Weights, 1 / sigma^2. */
  p: number[];
  /** Rows D of the datum constraints; empty for the control datum. */
  constraints: SparseMatrix;
  redundancy: number;
}

/** Normal equations N d = b, and S d_r = b' after elimination of the points. */
export interface NormalEquations {
  blocks: { name: string; kind: "photo" | "camera" | "point"; first: number; size: number; eliminated: boolean }[];
  N: SparseMatrix;
  b: number[];
  /** `unknowns` are the indices of its unknowns among all. */
  reduced: { unknowns: number[]; S: SparseMatrix; b: number[] };
  /** Blocks in the order in which they are eliminated. */
  elimination_order: number[];
  /** Entries of the lower triangle: of N, of its Cholesky factor, and of the factor with the photos eliminated first. */
  fill_in: { matrix: number; factor: number; factor_photos_first: number };
  rank: number;
  /** Movements that change no observation; rotations and scale about the object's centre. */
  null_space: { name: string; vector: number[] }[];
}

/** An adjustment run step by step. */
export interface Adjuster {
  /** Takes one step and returns the new state; has no effect after the last step. */
  step(): StepState;
  /** Goes back one step and returns that state; stops at the initial values. */
  back(): StepState;
  /** The current state. */
  state(): StepState;
  /** Completes the adjustment; returns the result of `adjust`. */
  finish(): Adjustment;
}

/** State of an adjustment after a step. */
export interface StepState {
  step: number;
  /** The project with the current values as initial values. */
  project: Project;
  /** The iteration that led to this state. */
  iteration?: Iteration;
  weighted_squares: number;
  sigma0?: number;
  /** In the order and units of `linearise(project).unknowns`. */
  values: number[];
  corrections: number[];
  /** Computed minus observed, in the order and units of `linearise(project).observations`. */
  residuals: number[];
  termination?: "converged" | "iteration_limit" | "diverged" | "stopped";
}

export interface AdjustOptions {
  /** [50] */
  max_iterations?: number;
  /** ["full"] */
  statistics?: "none" | "precision" | "full";
  /** [null] */
  robust?: null | "huber" | "tukey";
  /** Scale of robust weights: estimated but at least the a priori standard errors, or estimated without a bound ["at_least_prior"]. */
  robust_scale?: "at_least_prior" | "estimated";
  /** [false] */
  snooping?: boolean;
  /**
   * Where the residuals of the brown model are computed: at the measured position, to which the weights refer, or at the corrected position
   * as in other programs, for comparison ["measured"].
   */
  residuals?: "corrected" | "measured";
  /** Estimates the variances of image coordinates, control and the rest until sigma0 is 1; not with robust weights [null]. */
  variance_components?: null | { per_camera?: boolean; unmodelled?: boolean };
  /** Extra image error, a standard deviation added in quadrature to that of every image coordinate, pixels [0]. */
  unmodelled?: number;
  /** Diameter of circular targets without a diameter of their own, in the project's unit: corrects their eccentricity [null]. */
  target_diameter?: null | number;
  /** Points whose full covariance matrix is returned [none]. */
  covariance_of?: string[];
  /** Progress callback, called after every iteration; return `false` to cancel. */
  on_iteration?: (iteration: Iteration) => void | boolean;
}

export interface Correlation {
  names: string[];
  matrix: number[][];
}

export interface AdjustedCameraResult {
  /** The photo to which this interior orientation belongs, for a camera with per_photo. */
  photo?: string;
  /** Standard errors of the estimated parameters. */
  sigma: Partial<Record<Parameter, number>>;
  /** A priori standard errors of the document's camera; absent if none. */
  sigma_a_priori?: Partial<Record<Parameter, number>>;
  /** Absolute value of each estimated distortion parameter divided by its standard error. */
  significance: Partial<Record<Parameter, number>>;
  correlation: Correlation;
}

export type AdjustedCamera = Omit<CameraBase, "sigma"> & Interior & AdjustedCameraResult;

export interface AdjustedPhoto {
  id: string;
  position: [number, number, number];
  rotation: [number, number, number];
  sigma_position: [number, number, number] | null;
  /** Null where the attitude leaves the angles undefined (phi of 90 degrees). */
  sigma_rotation: [number, number, number] | null;
  /** Photo units. */
  rms_x: number;
  rms_y: number;
  /** Unit of the photo's residuals. */
  unit: "mm" | "px";
  /** Width and height of a pixel in that unit: residuals divided by them are pixels. */
  pixel: [number, number];
  points: number;
  /** Of X, Y, Z, omega, phi, kappa and the camera's estimated parameters. */
  correlation?: Correlation;
}

export interface AdjustedPoint {
  id: string;
  xyz: [number, number, number];
  sigma?: [number, number, number];
  /** xx, xy, xz, yy, yz, zz */
  covariance?: [number, number, number, number, number, number];
  rays: number;
}

export interface AdjustedObservation {
  photo: string;
  point: string;
  /**
   * Residuals in the photo's unit. For an observation that was not used: its difference from the adjusted values; null if photo or
   * point are not adjusted.
   */
  vx: number | null;
  vy: number | null;
  /** Redundancy numbers. */
  rx: number | null;
  ry: number | null;
  /** Baarda's w. */
  wx: number | null;
  wy: number | null;
  /** Minimal detectable bias. */
  mdb_x: number | null;
  mdb_y: number | null;
  /** External reliability: effect of an undetected bias of that size on the point, in the project's unit and datum. */
  effect_x: number | null;
  effect_y: number | null;
  /** Factor on the weight from robust weighting; absent where it is 1. */
  weight?: number;
  enabled: boolean;
}

/** An observation of another kind than image coordinates. */
export type GivenObservation = {
  /** Null if the observed quantity is not adjusted. */
  residual: number | null;
  sigma: number;
  reliability: { redundancy: number; w: number | null; mdb: number | null } | null;
  /** External reliability: largest effect of an undetected bias of that size on a point, in the project's unit. */
  effect: number | null;
  /** The most affected point: the control point itself, an end of the distance, a point of the photo, a point seen by the camera. */
  effect_point: string | null;
  /** Factor on the weight from robust weighting; absent where it is 1. */
  weight?: number;
  /** False if excluded by data snooping; the residual is then the difference from the adjusted value. */
  enabled: boolean;
} & Given;

/** Kinds of observations besides image coordinates; axis 0, 1, 2 for X, Y, Z. */
export type Given =
  | { kind: "control"; point: string; axis: number }
  | { kind: "position"; photo: string; axis: number }
  | { kind: "distance"; from: string; to: string }
  | { kind: "parameter"; camera: string; photo: string | null; parameter: Parameter };

/** Action of the gross error search on an observation. */
export interface GrossError {
  /** Empty for observations without one. */
  photo: string;
  /** Empty for observations without one. */
  point: string;
  /** The observed quantity; null for image coordinates. */
  given: Given | null;
  action: "removed" | "restored" | "downweighted" | "kept";
  statistic: number;
  limit: number;
  round: number;
  /** Whether it was excluded only because its point had a single ray left. */
  consequence: boolean;
}

/**
 * What the residuals of a camera depend on: the radius (lens distortion), a tangential pattern (decentring), affinity and shear, the row or
 * the column (rolling shutter), the position in the image, or single photos (refocused, cropped, of another size).
 */
export type PatternKind = "radius" | "tangential" | "affine" | "row" | "column" | "position" | "photo";

/** Remedy for a pattern of the residuals. */
export type Remedy =
  | { kind: "estimate"; parameters: Parameter[] }
  | { kind: "model"; models: string[] }
  | { kind: "hold_still" }
  | { kind: "own_camera"; photos: string[] }
  | { kind: "per_photo" }
  | { kind: "inspect" };

/** Test of the image residuals of a camera for a pattern; the redundancy of the residuals is accounted for. */
export interface ResidualPattern {
  camera: string;
  kind: PatternKind;
  /** Kind photo: photos with an interior orientation of their own; missing: all. */
  photos?: string[];
  /** Number of photos tested one by one (kinds row, column and photo); only a part of very large networks. */
  photos_tested?: number;
  /** Degrees of freedom of the pattern. */
  degrees: number;
  /** Fisher's F. */
  statistic: number;
  p_value: number;
  /** Root mean square and largest length of the pattern in the residuals, pixels. */
  rms_px: number;
  max_px: number;
  /** sigma0 without the pattern. */
  sigma0: number;
  /** Whether the advice names it as the cause; at most one is. */
  named: boolean;
}

/** Strongly correlated parameters of a camera, or of a photo with its camera. */
export interface CorrelationGroup {
  camera: string;
  /** The photo, if one parameter of each pair or the interior orientation belongs to a photo. */
  photo: string | null;
  /** The largest correlation first. */
  pairs: { first: string; second: string; correlation: number }[];
  /** The parameter to hold first; null if neither of the first pair belongs to a camera. */
  hold: Parameter | null;
}

/** Weaknesses of a solvable network. */
export type Advice =
  | { kind: "high_correlation"; camera: string; photo: string | null; first: string; second: string; correlation: number }
  | { kind: "low_redundancy"; observations: [string, string][]; given: Given[] }
  | { kind: "two_rays"; points: string[] }
  | { kind: "narrow_intersection"; points: [string, number][] }
  | { kind: "behind_camera"; observations: [string, string][] }
  | { kind: "distance_unused"; distances: [string, string][] }
  | { kind: "weak_principal_distance"; camera: string; photo: string | null; parameter: string; value: number; sigma: number; convergence: number }
  | { kind: "gross_errors_unsettled" }
  | { kind: "variance_components_unsettled" }
  /** The residuals of a camera are systematic: pattern and remedy. Listed before advice that treats them as noise. */
  | {
      kind: "residual_pattern";
      camera: string;
      pattern: PatternKind;
      /** Photos concerned; empty: all. */
      photos: string[];
      p_value: number;
      rms_px: number;
      max_px: number;
      /** sigma0 without the pattern. */
      sigma0: number;
      remedy: Remedy;
    }
  /** The global test failed with a sigma0 beyond its limit; the extra image error `unmodelled` (pixels) would make it pass. */
  | { kind: "sigmas_too_small"; sigma0: number; unmodelled: number | null }
  /** The test fails although `unmodelled` was given; use this value instead. */
  | { kind: "unmodelled_again"; sigma0: number; unmodelled: number }
  /** A distortion parameter that is not significantly different from 0, and the one with which it is most correlated. */
  | {
      kind: "insignificant";
      camera: string;
      photo: string | null;
      parameter: Parameter;
      ratio: number;
      with: Parameter | null;
      correlation: number | null;
    }
  /** Observations whose |w| exceeds the critical value, reported if the largest is significant among so many: image observations with the
   * largest |w| (at most 20), others. */
  | { kind: "suspected"; count: number; observations: [string, string, number][]; given: [Given, number][] }
  /** Given coordinates minus those from all other observations, and the size of the difference in its standard errors. */
  | { kind: "control_misfit"; point: string; difference: [number, number, number]; sigma_ratio: number }
  /** Two control points whose coordinates fit when they are exchanged. */
  | { kind: "exchanged_points"; points: [string, string] }
  /** Points closer than their standard errors can separate. */
  | { kind: "double_points"; pairs: [string, string][] }
  | ({ kind: "mirrored_control" } & MirroredControl)
  | ({ kind: "undecided_axes" } & UndecidedAxes)
  | ({ kind: "unit_ratio" } & UnitRatio)
  | ({ kind: "one_station" } & OneStation)
  | ({ kind: "implausible_camera" } & ImplausibleCamera)
  /** No scale: lengths have no unit; only their ratios are right. */
  | { kind: "no_scale" };

/** An item of the input that was not used in the adjustment. */
export interface LeftOut {
  /** control: a control point, or one of its coordinates (`given` has the axis). */
  kind: "observation" | "control" | "distance" | "point" | "photo" | "position" | "parameter";
  photo?: string;
  point?: string;
  /** The observed quantity, for kinds other than image coordinates: ends of a distance, axis of a coordinate. */
  given?: Given;
  /** document: disabled in the document; adjustment: an item it depends on was not used. */
  by: "orientation" | "matching" | "snooping" | "robust" | "document" | "adjustment";
  reason:
    | "disagrees"
    | "photo_not_oriented"
    | "point_not_determined"
    | "undecided"
    | "gross_error"
    | "consequence"
    | "no_weight"
    | "disabled"
    | "photo_disabled"
    | "not_measured";
  /** Image observations: distance from the position computed with the adjusted values. */
  size_px?: number;
  /** Others: adjusted minus given; for a control point the distance of the given coordinates from the position in the photos. */
  size?: number;
  /** The same in standard errors of the difference; absent without statistics. */
  size_sigma?: number;
}

/** Two axes exchanged, or one with the other sign. */
export type Exchange = "xy" | "xz" | "yz" | "x" | "y" | "z";

/** Given coordinates are a mirror image of the object. `exchange` corrects it; `alternatives` would as well, and the photos cannot distinguish
 * them. Standard deviations of a coordinate in the similarity transformation between both, project unit. */
export interface MirroredControl {
  exchange: Exchange;
  alternatives?: Exchange[];
  rms_given: number;
  rms_exchanged: number;
  points: number;
}

/** Given points lie in a plane, so the data do not show whether their axes are mirrored. With the axes as given, the cameras are on the side
 * to which `normal` points. */
export interface UndecidedAxes {
  points: number;
  normal: [number, number, number];
}

/** A length is `ratio` times the value implied by the other data, close to the ratio of two units (`nearest`: 1000, 25.4, 304.8, 10, 12, 100 ...
 * or an inverse). */
export interface UnitRatio {
  of: "control" | "distance" | "camera";
  ratio: number;
  nearest: number;
  /** The distances compared. */
  distances?: [string, string][];
  /** The camera whose principal distance it is. */
  camera?: string;
}

/** Photos taken from one place; if all were, depth and principal distance are undetermined. */
export interface OneStation {
  photos: string[];
  all: boolean;
}

/** A camera with implausible data; orientation does not use it as given. */
export type ImplausibleCamera = { camera: string } & (
  /** Along the longer side, radians; below 1° or above 150°. `pixels`: the camera has no pixel pitch, so that `value` counts pixels. */
  | { reason: "field_of_view"; angle: number; value: number; pixels: boolean }
  /** Photos with measurements outside the camera's image size; largest u and v. */
  | { reason: "image_size"; photos: string[]; size: [number, number]; measured: [number, number] }
  /** A photo of `factor` times the camera's size. */
  | { reason: "resized"; photo: string; factor: number }
  /** A photo cropped from an image of the camera, starting at `offset`, pixels. */
  | { reason: "cropped"; photo: string; offset: [number, number] }
  /** A photo taken at another principal distance. */
  | { reason: "other_distance"; photo: string; value: number }
);

/** An estimated variance component. */
export interface VarianceComponent {
  /** Camera null: image coordinates of all cameras. */
  group:
    | { kind: "image"; camera: string | null }
    | { kind: "control" }
    | { kind: "position" }
    | { kind: "distance" }
    | { kind: "parameter" };
  observations: number;
  redundancy: number;
  /** Factor on the a priori standard errors of the group, and its standard error; null if the redundancy of the group is too small. */
  factor: number;
  factor_sigma: number | null;
  /** Extra image error, pixels; null unless requested. */
  unmodelled: number | null;
  unmodelled_sigma: number | null;
  /** Image coordinates: root mean square of the a priori standard errors to which the factor applies, pixels. */
  a_priori_px: number | null;
  /** Why the group was not estimated and keeps its a priori standard errors; null if it was. */
  not_estimated: null | { kind: "little_redundancy"; needed: number } | { kind: "no_residuals" };
}

/** Criteria of the tests and of the advice. */
export interface Criteria {
  /** Two-sided error probability of the tests on single observations. */
  alpha: number;
  /** Power with which a minimal detectable bias is detected. */
  power: number;
  /** Two-sided error probability of the global test. */
  global_alpha: number;
  /** Critical value of Baarda's |w|. */
  w: number;
  /** Critical value of Pope's |tau|; null with a redundancy below 2. */
  tau: number | null;
  /** Non-centrality of minimal detectable biases. */
  noncentrality: number;
  /** Observations with a smaller redundancy number are unchecked. */
  unchecked: number;
  /** Observations with a smaller redundancy number are hardly checked. */
  low_redundancy: number;
  /** Parameters with a larger |correlation| are strongly correlated. */
  high_correlation: number;
  /** Rays that intersect at a smaller angle determine no depth, radians. */
  narrow_intersection: number;
  /** Distortion parameters below this multiple of their standard errors are not significantly different from 0. */
  significance: number;
  /** A sigma0 above this, with the global test failed, means that the standard errors are too small. */
  sigma0: number;
}

/** A camera of a rig relative to the first one: rotation M_own M_firstᵀ, position M_first (X_own - X_first), means over the exposures. */
export interface RelativePose {
  /** Its column in the rig's exposures. */
  column: number;
  camera: string;
  relative_to: string;
  /** Projection centre in the first camera's axes (x right, y up, z back), in the project's unit. */
  position: [number, number, number];
  sigma_position: [number, number, number] | null;
  /** Omega, phi, kappa from the first camera's axes to its own, radians. */
  rotation: [number, number, number];
  /** Of small turns about its own camera axes, radians. */
  sigma_rotation: [number, number, number] | null;
  /** Distance of the two projection centres. */
  base: number;
  sigma_base: number | null;
  /** Deviation of each exposure: position in the first camera's axes, rotation about the camera's own axes, radians. */
  exposures: {
    exposure: number;
    photos: [string, string];
    position: [number, number, number];
    rotation: [number, number, number];
    /** Sum of the redundancy numbers, 0 to 6; null without statistics, with one exposure, and under robust weights. */
    redundancy: number | null;
    degrees: number | null;
    /** F statistic of a relative pose of its own. */
    statistic: number | null;
    p_value: number | null;
    /** The most significant one of the rig, beyond 0.001: the mount gave, or the photos were not taken together. */
    outlier: boolean;
  }[];
  /** Rms of the deviations per axis with n - 1 exposures; null with one. */
  scatter_position: number | null;
  scatter_rotation: number | null;
}

/** The result; no number in it is NaN or infinite. */
export interface Adjustment {
  /** The options used. */
  options: Required<Omit<AdjustOptions, "on_iteration">>;
  termination: "converged" | "iteration_limit" | "diverged" | "stopped";
  iterations: Iteration[];
  observations_count: number;
  unknowns: number;
  constraints: number;
  redundancy: number;
  /** Null where the redundancy is 0. */
  sigma0: number | null;
  /** Null if the redundancy is 0, and with estimated variance components, which make the statistic equal to the redundancy. */
  global_test: { statistic: number; lower: number; upper: number; passed: boolean } | null;
  /** Rms of the residuals of all image coordinates used, pixels. */
  rms_px: number | null;
  criteria: Criteria;
  cameras: AdjustedCamera[];
  photos: AdjustedPhoto[];
  /** There when the project has a rig: every camera of it but the first, as far as they have an exposure together. */
  rig?: RelativePose[];
  points: AdjustedPoint[];
  /** In the project's order; created when first read. */
  observations: AdjustedObservation[];
  check_points: { id: string; difference: [number, number, number] | null }[];
  /** Check distances, adjusted minus given; sigma from the full covariance of their ends. */
  check_distances?: { from: string; to: string; length: number; difference: number | null; sigma: number | null }[];
  precision: {
    rms_sigma: [number, number, number];
    mean_q: [number, number, number];
    /** Largest distance between two points. */
    largest_dimension: number;
    relative: number | null;
  } | null;
  check_statistics: {
    count: number;
    min: [number, number, number];
    max: [number, number, number];
    mean: [number, number, number];
    standard_deviation: [number, number, number] | null;
    rms: [number, number, number];
    /** Of all axes together. */
    rms_all: number;
  } | null;
  given: GivenObservation[];
  gross_errors: GrossError[];
  /** Largest correction in pixels of every target with a diameter, null if its normal is unknown. Present if a target has a diameter. */
  eccentricity?: { point: string; correction_px: number | null }[];
  /** Present if requested. */
  variance_components?: VarianceComponent[];
  /** Tests of the image residuals for patterns; missing without full statistics, and where the iteration did not converge. */
  patterns?: ResidualPattern[];
  advice: Advice[];
  /** Its `high_correlation` entries in groups; missing without any. */
  correlation_groups?: CorrelationGroup[];
  /** Every item of the input that was not used; empty if all were. */
  left_out: LeftOut[];
  /** Of the requested points, three rows each in their order. */
  covariance?: { points: string[]; matrix: number[][] };
  /** The document's features, measured on this result. */
  features?: MeasuredFeature[];
  /** The document's coordinate systems. */
  systems?: MeasuredSystem[];
}

/** Ring codes by maker and bits: ring-12 to ring-20 are Schneider / AICON's, metashape-12 to metashape-20 Metashape's circular ones. */
export type CodeFamily =
  | "ring-12" | "ring-14" | "ring-16" | "ring-20"
  | "metashape-12" | "metashape-14" | "metashape-16" | "metashape-20";

/** A possible reading of a ring; the margin is 0 if the reading is doubtful within its family. */
export interface CodeCandidate {
  family: CodeFamily;
  number: number;
  margin: number;
}

/** A family's codes in the order in which they should be used. */
export interface CodeSpread {
  /** All numbers of the family, those with the largest mutual distance first. */
  numbers: number[];
  /** How many of the first numbers differ by at least `distance` sectors in every rotation; descending. */
  counts: { distance: number; codes: number }[];
}

export interface DetectOptions {
  /** ["least_squares"] */
  method?: "least_squares" | "ellipse" | "intensity" | "gradient";
  /** ["auto"] */
  polarity?: "auto" | "bright" | "dark";
  /** ["grey"] the luma plane of a colour JPEG as stored; of other colour pictures 0.2126 R + 0.7152 G + 0.0722 B */
  channel?: "grey" | "red" | "green" | "blue";
  /** Ring codes to read; "auto": the only family that fits every ring of the photo ["none"] */
  codes?: "none" | CodeFamily | "auto";
  /** Minimum full minor axis of a target in pixels [5]. */
  min_diameter?: number;
  /** Maximum full major axis of a target in pixels [400]. */
  max_diameter?: number;
  /** Minimum ratio of a target's axes, 0.15 to 1: the cosine of the largest viewing angle [0.29]. */
  min_axis_ratio?: number;
}

/** Quality of a target's image. */
export interface Quality {
  fit_rms: number;
  noise: number;
  edge_width: number;
  saturated: number;
  roundness: number;
  occluded: number;
  /** Reliability of the code reading, 0 (a coin toss) to 1; null if no ring was detected. */
  code_margin: number | null;
  /** Why a ring was detected but not read. */
  code_note: "all_set" | "no_code" | "disturbed" | "between_levels" | "other_family" | "uncertain" | "several_families" | "unread" | null;
}

/** The inner edge of a ring-shaped target: pixels, radians; major and minor are the ellipse's full axes. */
export interface InnerRim {
  u: number;
  v: number;
  sigma_u: number;
  sigma_v: number;
  covariance_uv: number;
  major: number;
  minor: number;
  angle: number;
  /** Whether the two centres differ by more than their standard errors explain (at 0.1 %). */
  off_centre: boolean;
}

/** A target of a photo: pixels, radians; major and minor are the ellipse's full axes. */
export interface Target {
  /** Number in its photo, from 1; 0 for a target measured individually. */
  id: number;
  u: number;
  v: number;
  sigma_u: number;
  sigma_v: number;
  covariance_uv: number;
  major: number;
  minor: number;
  angle: number;
  contrast: number;
  polarity: "bright" | "dark";
  code: number | null;
  /** Family of the code. */
  code_family: CodeFamily | null;
  /** Possible codes if the reading is not reliable, and under "auto" those of other families; margin 0 if doubtful. */
  code_candidates: CodeCandidate[];
  /** The inner edge of a ring-shaped target, whose outer edge is the target. */
  inner?: InnerRim;
  /**
   * Whether something hides a part of its rim: its centre is that of the ellipse through the visible edges, with a standard error for what
   * those cannot show. Neither codes nor matching name it; it takes part where a user names it.
   */
  occluded?: boolean;
  quality: Quality;
}

export type RejectionReason =
  | "too_small" | "too_large" | "not_an_ellipse" | "too_flat" | "low_contrast" | "touching" | "saturated" | "at_border" | "occluded"
  | "code_ring" | "no_fit";

/** Processing and noise of a picture, estimated from its samples. */
export interface PictureReport {
  /** Amount of unsharp masking estimated from the edges, 0 if none, and the sigma of its kernel in pixels. */
  sharpening: number;
  sharpening_radius: number;
  /** Share of samples at either end of the scale, 0 to 1. */
  clipped_dark: number;
  clipped_bright: number;
  /** Relative excess of differences across the borders of 8 x 8 blocks. */
  compression: number;
  /** Standard deviation of single samples in grey levels. */
  noise: number;
  /** Noise autocorrelation: standard errors of centres relative to those with white noise; 1 for uncorrelated pixels. */
  noise_correlation: number;
  /** Whether the standard errors assume uncorrelated noise (every method except least squares): too small for a compressed picture. */
  white_noise_assumed: boolean;
  /** Whether targets were also detected and measured on a smoothed copy. */
  softened: boolean;
}

/** Colour of a sensor filter. */
export type Colour = "red" | "green" | "blue" | "cyan" | "magenta" | "yellow" | "white" | "emerald";

/** The sensor samples used for the measurement; levels and noise in units of these samples. */
export interface MeasuredSamples {
  /** "sites": without interpolation; "interpolated_sites": on an interpolated picture, for methods other than "least_squares". */
  on: "sites" | "interpolated_sites";
  format: string;
  colour: Colour | null;
  /** Filters, one letter per pixel, row by row. */
  pattern: string | null;
  bits: number;
  /** The exposed part of the grid: left, top, width, height. Coordinates refer to the whole grid. */
  active_area: [number, number, number, number] | null;
  /** Saturation level. */
  white: number | null;
  /** Increase of a sample's variance per unit of light. */
  gain: number | null;
  /** Standard deviation of a sample without light; null if the photo has no dark area to estimate it. */
  read_noise: number | null;
  /** Number of hot pixels. */
  hot_sites: number | null;
  /** Lens corrections listed in the file, by their names there; none is applied. */
  corrections: string[];
  /** Number of unreadable lists of lens corrections in the file. */
  unread_corrections: number;
}

/** Lateral chromatic aberration of a channel relative to green. */
export interface Lateral {
  /** Shift of the whole picture, in pixels. */
  shift_u: number;
  shift_v: number;
  /** Parts that grow with the radius and with its third power, in pixels at the corner; positive outwards. */
  linear: number;
  cubic: number;
  /** Sum of both at the corner, and its standard error. */
  at_corner: number;
  sigma_at_corner: number;
  /** Rms of the residuals: in pixels, and in units of their standard errors. */
  rms: number;
  sigma0: number;
  /** Number of targets used. */
  targets: number;
  /** Whether the shift at some radius exceeds three of its standard errors and 0.02 pixels. */
  significant: boolean;
  /** Covariances of `shift_u`, `shift_v`, `linear` and `cubic`, square pixels: the upper triangle, row by row. */
  covariance: number[];
}

/** Targets in red or blue minus the same targets in green. */
export interface ColourApart {
  colour: Colour;
  /** Centre in green, difference and its standard errors, pixels. */
  shifts: { u: number; v: number; du: number; dv: number; sigma_u: number; sigma_v: number }[];
  /** Null where there are too few targets. */
  lateral: Lateral | null;
}

export interface ColoursApart {
  /** Middle of the exposed part, origin of the radii, and the radius of its corners. */
  centre: [number, number];
  corner: number;
  /** Red and blue; empty for a sensor without filters. */
  colours: ColourApart[];
}

export interface Detection {
  width: number;
  height: number;
  bits: number;
  /** Rows that could not be decoded and were not measured: first row and the row after the last. Empty for an intact file. */
  damaged_rows: [number, number][];
  /** Picture measured in a TIFF with several: its number from 1, how many there are, and how many reduced copies and masks were skipped. */
  page?: { number: number; of: number; skipped: number };
  picture: PictureReport;
  /** Present if sensor samples (RAW) were measured. */
  measured?: MeasuredSamples;
  targets: Target[];
  rejected: Partial<Record<RejectionReason, number>>;
  /** Created when first read. */
  rejected_blobs: { u: number; v: number; diameter: number; reason: RejectionReason }[];
}

/** Metadata of a photo's file; null if missing. */
export interface PhotoInfo {
  width: number;
  height: number;
  bits: number;
  make: string | null;
  model: string | null;
  focal_length_mm: number | null;
  focal_length_35mm: number | null;
  pixel_pitch: [number, number] | null;
  /** EXIF orientation of the stored grid for display, 1 to 8. */
  orientation: number;
  date: string | null;
  /** Lens corrections according to the maker note. */
  corrections?: LensCorrection[];
}

/** A lens correction in the maker note: applied, not applied, or applied if the camera knows the lens. */
export interface LensCorrection {
  aberration: "distortion" | "lateral_colour" | "vignetting" | "diffraction";
  setting: "off" | "on" | "auto";
  /** Source tag, e.g. "Sony 0x2013". */
  tag: string;
}

/** The targets detected in one photo. */
export interface PhotoTargets {
  photo: string;
  targets: (Omit<Target, "id"> & { id?: number })[];
}

/** A target whose identity is in doubt: shown to the user, not used. */
export interface Doubtful {
  photo: string;
  u: number;
  v: number;
  /** Number of the target in its photo, where it has one. */
  target?: number;
  points: string[];
  reason: "duplicate_code" | "code_family" | "code_unclear" | "occluded" | "ambiguous" | "disagrees";
}

export interface NameCodedOptions {
  /** Family of the codes [null: the only one that fits every ring of all photos]. */
  family?: CodeFamily | null;
}

export interface Coded {
  points: Point[];
  observations: Observation[];
  doubtful: Doubtful[];
  /** The family used. */
  family: CodeFamily | null;
  /** The families that fit every ring; several if one must be chosen, none if the rings belong to different families. */
  families: CodeFamily[];
}

/** An approximate measurement of a point in a photo. */
export interface Mark {
  photo: string;
  point: string;
  u: number;
  v: number;
  sigma: number;
}

export interface MatchOptions {
  /** Maximum distance of a target from the predicted position, pixels [null: from the residuals]. */
  tolerance_px?: number | null;
  /** Minimum number of rays of a new point [3]. */
  min_rays?: number;
}

export interface Matching {
  /** New points, with coordinates. */
  points: Point[];
  /** New observations of new and existing points. */
  observations: Observation[];
  doubtful: Doubtful[];
}

/**
 * A board of circular dots. Its coordinates: the first dot at (0, 0, 0), x along its row, y down the rows, z away from the viewer.
 * Dot (i, j) of row i and column j stands at (j, i) pitches on a symmetric board and at (2 j + i mod 2, i) on an asymmetric one.
 */
export interface Board {
  rows: number;
  /** Dots in each row. */
  columns: number;
  /** Distance of two rows, in the unit of the project; the dots of a row of an asymmetric board are two pitches apart. */
  pitch: number;
  kind?: "symmetric" | "asymmetric";
  /** Diameter of the dots: assigned to the points, and distinguishes this board from others [null]. */
  diameter?: number | null;
  /** Standard error of the dots' coordinates, which makes them control points; 0 holds them [null: tie points with initial values from the board]. */
  sigma?: number | null;
  /** Position (x, y) on the board of an additional target that marks the first corner [null]. */
  mark?: [number, number] | null;
}

export interface GridOptions {
  /** By photo, the pixel of the board's first dot, for boards that look the same when turned; one photo is enough [{}]. */
  first?: Record<string, [number, number]>;
}

export interface GridNaming {
  /** Prefix of the names: "", or "b2-", "b3-" if the project has other points of these names. Row and column from 1 follow: "r3c5". */
  prefix: string;
  /** Dots without a point in the project. */
  points: Point[];
  /** Observations that are new in the project. */
  observations: Observation[];
  named: {
    photo: string;
    dots: number;
    /** Dots of the board that are not in the photo. */
    missing: number;
    /** Dots that were observed under another name before and keep it. */
    named_before: number;
    /** "assumed": the board looks the same when turned; the rotation with rows to the right was assumed. */
    orientation: "unique" | "mark" | "given" | "assumed";
    /** Number of rotations under which the board looks the same. */
    turns: number;
    /** Whether the empty border gave the position on the board. */
    by_border: boolean;
  }[];
  unnamed: { photo: string; reason: UnnamedReason; sentence: string }[];
}

export type UnnamedReason =
  | { kind: "no_grid"; targets: number }
  | { kind: "not_this_board"; dots: number }
  | { kind: "ambiguous"; dots: number; places: number }
  | { kind: "several_boards"; count: number }
  | { kind: "other_dots"; dots: number; others: number }
  | { kind: "mark"; seen: number }
  | { kind: "diameter"; seen: number; given: number };

export interface PredictOptions {
  /** Photos in which epipolar lines are returned [null: all]. */
  lines_in?: string[] | null;
}

/** Predicted position of a point, from its rays. */
export interface Prediction {
  point: string;
  /** Number of oriented photos in which it is measured and used. */
  rays: number;
  /** Null with fewer than two rays, or if they do not intersect. */
  xyz: [number, number, number] | null;
  /** Null if the orientation of a photo that measured it has no standard errors. */
  sigma: [number, number, number] | null;
  /** Oriented photos whose orientation has no standard errors; predictions that use one have no covariance. */
  without_errors: string[];
  /** Every oriented photo. */
  photos: PhotoPrediction[];
}

/** Predicted position of a point in one photo, pixels; its measurement in that photo is not used. */
export interface PhotoPrediction {
  photo: string;
  measured: [number, number] | null;
  place: [number, number] | null;
  /** uu, uv, vv of the place; null without the standard errors of the photos' orientations. */
  covariance: [number, number, number] | null;
  /** Lower bound of the covariance, from its known part. */
  least_covariance: [number, number, number] | null;
  /** Whether the predicted position lies in the picture. */
  inside: boolean;
  /** Distance of the measurement from the predicted position, in pixels and in standard errors of both. */
  off_px: number | null;
  off_sigmas: number | null;
  /** Epipolar line of each other photo, as a polyline. */
  lines: { from: string; course: [number, number][] }[];
}

/** A note on the orientation: an assumption, or a failure with its reason. */
export type Note =
  | { note: "principal_distance"; camera: string; value: number; source: "known_points" | "assumed" }
  /** The principal distance is weakly determined; sigma is null if it is not determined at all. */
  | { note: "principal_distance_weak"; camera: string; value: number; sigma: number | null }
  | { note: "principal_distance_changed"; camera: string; value: number; given: number }
  /** Groups of photos that are not connected; the first, largest group is oriented. */
  | { note: "groups"; groups: string[][] }
  /** Two orientations fit the photo's known points equally well: the one not used; rms of the one used and the other. */
  | {
      note: "photo_ambiguous";
      photo: string;
      position: [number, number, number];
      rotation: [number, number, number];
      rms_px: [number, number];
    }
  | { note: "system"; source: "known_points" | "given_photos" | "own"; scale: "given" | "arbitrary" }
  | ({ note: "photo_not_oriented"; photo: string } & (
      | { why: "no_points" }
      | { why: "too_few_points"; determined: number; needed: number }
      | { why: "disagrees"; determined: number }
      | { why: "other_group"; group: number }
    ))
  | ({ note: "point_not_determined"; point: string } & (
      | { why: "not_measured" | "rays_disagree" | "coordinates_missing" }
      | { why: "seen_once" | "behind_camera"; photo: string }
      | { why: "too_few_oriented_photos"; photos: number }
      | { why: "near_parallel"; angle: number }
      /** The rays intersect at two positions, equally many at each: the photos of each. */
      | { why: "undecided"; first: string[]; second: string[] }
    ))
  | { note: "measurement_disagrees"; photo: string; point: string; distance_px: number | null }
  /** Given coordinates minus those from photos oriented by the other control points; size of the difference in standard errors of both. */
  | { note: "control_misfit"; point: string; difference: [number, number, number]; sigma_ratio: number }
  /** Two control points whose coordinates fit when they are exchanged. */
  | { note: "exchanged_points"; points: [string, string] }
  /** Points closer than their standard errors can separate. */
  | { note: "double_points"; pairs: [string, string][] }
  | ({ note: "mirrored_control" } & MirroredControl)
  | ({ note: "undecided_axes" } & UndecidedAxes)
  | ({ note: "unit_ratio" } & UnitRatio)
  /** If all photos are affected and there are no control points, nothing is oriented. */
  | ({ note: "one_station" } & OneStation)
  | ({ note: "implausible_camera" } & ImplausibleCamera)
  | { note: "no_scale" };

export interface OrientedProject extends Project {
  notes: Note[];
}

export interface Snapped {
  observations: Observation[];
  unsnapped: { mark: Mark; reason: "no_detection" | "no_target" | "contested" | "marked_twice"; points?: string[] }[];
}

/** A camera station: its position with either a rotation (omega, phi, kappa in radians) or an aim point and a roll. */
export interface Station {
  id: string;
  camera: string;
  position: [number, number, number];
  rotation?: [number, number, number] | null;
  look_at?: [number, number, number] | null;
  roll?: number;
}

export interface NetworkPoint {
  id: string;
  role?: "tie" | "control" | "check";
  xyz: [number, number, number];
  sigma?: [number | null, number | null, number | null] | null;
  /** Direction the target faces; null: visible from everywhere, and not rendered. */
  normal?: [number, number, number] | null;
  diameter?: number | null;
  ring?: { sectors: number; code: number } | null;
  grey?: number | null;
  patch?: { ratio: number; grey: number } | null;
}

/** A parallelogram that is rendered and occludes what lies behind it. */
export interface Face {
  corner: [number, number, number];
  along: [number, number, number];
  across: [number, number, number];
  grey?: number;
  texture?: number;
  grain?: number;
}

/** A planned network, from which a project is simulated. */
export interface Network {
  name?: string;
  unit?: string;
  cameras: Camera[];
  stations: Station[];
  points: NetworkPoint[];
  faces?: Face[];
  background?: number;
  distances?: { from: string; to: string; sigma: number }[];
  datum?: Datum;
  /** Maximum angle between the ray and the direction a target faces, radians. */
  max_incidence?: number;
  /** Points closer than this to the picture's border are not measured, pixels. */
  margin?: number;
  /** A priori standard error of the observations, pixels [0.1]. */
  sigma?: number | [number, number];
  /** Standard deviation of the noise, pixels; null: that of sigma. */
  noise?: number | [number, number] | null;
  /** ["noisy"] */
  observations?: "exact" | "noisy" | "rendered";
  seed?: number;
  exposure?: { psf?: number; vignetting?: number; read_noise?: number; shot_noise?: number; bits?: 8 | 16; seed?: number };
  detect?: DetectOptions;
}

/** Contents of printed target sheets. Lengths in mm; positions on a sheet from its top left corner, x right, y down. */
export interface SheetOptions {
  /** Title at the top of every sheet. */
  title?: string;
  /** Language of the sheets ["en"]. */
  language?: "en" | "ko";
  /** ["a4"] */
  paper?: "a4" | "a3" | "letter";
  /** ["ring-14"] */
  family?: CodeFamily;
  /** Numbers of the codes, e.g. "1-20, 35"; empty: the first `codes` of those with the largest mutual distance. */
  numbers?: string;
  /** [20] */
  codes?: number;
  /** Diameter of the dots [10]. */
  diameter?: number;
  /** Black on white, or white on black ["paper"]. */
  ground?: "paper" | "retro";
  /** Plain dots [0]. */
  dots?: number;
  /** ["regular"] */
  pattern?: "regular" | "jittered";
  /** Pairs of codes that are ends of scale bars [0]. */
  bars?: number;
  /** Distance of the ends of a pair; a distance that fits on the paper is printed [1000]. */
  bar_length?: number;
  /** A plate with codes and dots over sheets edge to edge. */
  field?: { columns: number; rows: number } | null;
  cut_marks?: boolean;
  labels?: boolean;
  /** Measured length of the printed 100 mm ruler across. */
  measured?: number | null;
  /** Measured length of the ruler down; null: as across. */
  measured_down?: number | null;
  /** [0.1] */
  measured_sigma?: number;
  seed?: number;
}

export interface PrintedTarget {
  /** The code's number, or "d" and a number. */
  id: string;
  kind: "code" | "dot" | "bar_end";
  number: number | null;
  /** Counted from 1. */
  sheet: number;
  at: [number, number];
  /** Nominal coordinates on the plate of a calibration field, X right, Y up, with the scale of the print. */
  plate: [number, number] | null;
}

export interface TargetSheet {
  /** The sheets, true to scale. */
  svg: string[];
  /** "sheets.pdf", "targets.csv", and "distances.csv" and "control.csv" if there are any. */
  files: Record<string, Uint8Array>;
  targets: PrintedTarget[];
  /** Scale bars; sigma is null if the ends are mounted by hand. */
  bars: { from: string; to: string; length: number; sigma: number | null }[];
  /** Smallest mutual distance of the codes; null with fewer than two. */
  least_distance: number | null;
  /** Scale of the print across and down, 1 until a ruler is measured. */
  scale: [number, number];
  scale_sigma: number;
  /** Diameter of the dots on paper. */
  diameter: number;
}

/** How many codes of a family differ by at least `distance` sectors in every rotation. */
export interface CodeCount {
  distance: number;
  count: number;
}

export interface TargetAdviceOptions {
  /** Principal distance in pixels. */
  c_px: number;
  distances: number[];
  /** Between ray and normal, radians. */
  angles: number[];
  diameter: number;
}

export interface TargetAdvice {
  distance: number;
  /** Size of a pixel on the object. */
  pixel: number;
  /** Diameter of 8 px at each angle. */
  least: number[];
  /** Diameter of 15 px at each angle. */
  best: number[];
  /** Smaller axis of the dots at each angle, pixels. */
  pixels: number[];
}

/** A planned camera station: a rotation, or an aim point and a roll. */
export interface PlanStation {
  id?: string;
  /** [the plan's first] */
  camera?: string;
  position?: [number, number, number];
  look_at?: [number, number, number] | null;
  rotation?: [number, number, number] | null;
  roll?: number;
  taken?: boolean;
}

export interface PlanFace {
  corner: [number, number, number];
  along: [number, number, number];
  across: [number, number, number];
}

export type PlanForm =
  | { kind: "plane"; width: number; height: number; columns: number; rows: number; upright: boolean; diameter: number }
  | { kind: "box"; size: [number, number, number]; columns: number; rows: number; diameter: number }
  | { kind: "cylinder"; radius: number; height: number; sweep: number; columns: number; rows: number; inside: boolean; diameter: number };

export interface FormTargets {
  points: Point[];
  faces: PlanFace[];
}

/** Plan: targets, camera stations and required accuracy. Lengths in the project's unit, angles in radians. */
export interface Plan {
  cameras?: Camera[];
  /** Depth of field; everything is sharp without f-number, focus or pixel pitch. */
  lens?: { f_number?: number | null; focus?: number | null; circle_px?: number; unit_mm?: number };
  form?: PlanForm | null;
  points?: Point[];
  faces?: PlanFace[];
  distances?: { from: string; to: string; sigma: number }[];
  datum?: Datum;
  stations?: PlanStation[];
  variants?: { name?: string; stations?: PlanStation[] }[];
  /** Boxes without access for the camera. */
  forbidden?: { low: [number, number, number]; high: [number, number, number] }[];
  /** Standard error of an image coordinate, pixels [0.05]. */
  sigma?: number;
  /** [60°] */
  max_incidence?: number;
  /** Pixels [10]. */
  margin?: number;
  /** Minimum axis of a target's image, pixels [8]. */
  least_px?: number;
  wanted?: { precision?: number; probability?: number };
}

export type PlanCriterion =
  | { kind: "worst" }
  | { kind: "mean" }
  | { kind: "points"; points: string[] }
  | { kind: "parameter"; parameter: string };

export interface PredictedStation {
  id: string;
  points: string[];
  unseen: { outside: number; turned_away: number; hidden: number; too_small: number; blurred: number };
  /** Median distance to the points it sees. */
  distance: number | null;
  smallest_px: number | null;
  direction: [number, number, number];
  /** Corners of its picture as directions, clockwise from the top left. */
  corners: [number, number, number][];
  forbidden: boolean;
}

export interface PredictedPoint {
  id: string;
  rays: number;
  /** Largest acute angle between two rays. */
  angle: number;
  sigma: [number, number, number] | null;
  covariance: [number, number, number, number, number, number] | null;
  /** Largest half axis of the standard ellipsoid. */
  axis: number | null;
  /** Smallest displacement that a comparison with a second campaign like this finds; null if `PlanPrediction.repeated` is null. */
  detectable: Detectable | null;
}

/** Smallest detectable displacement along X, Y, Z and along the least favourable direction; null along an axis on which the point is held. */
export interface Detectable {
  axes: [number | null, number | null, number | null];
  worst: number;
}

/** How two campaigns as planned are compared, with the usual options of `compareEpochs`. */
export interface RepeatedCampaign {
  reference: string[];
  reference_from: "control" | "datum" | "common";
  significance: number;
  power: number;
  /** Degrees of freedom of both campaigns' variance factor. */
  redundancy: number;
  /** Point with the largest of the smallest detectable displacements, and that displacement. */
  point: string | null;
  largest: number | null;
}

/** Predicted accuracy of a plan; standard errors are 1σ. */
export interface PlanPrediction {
  stations: PredictedStation[];
  points: PredictedPoint[];
  cameras: AdjustedCamera[];
  worst: string | null;
  largest: number | null;
  rms: number | null;
  /** Factor from standard errors to the required probability. */
  factor: number;
  redundancy: number | null;
  reached: boolean;
  lacks: (
    | { kind: "no_photos" | "no_points" }
    | { kind: "undetermined" | "beyond"; points: string[] }
    | { kind: "defect"; defect: Record<string, unknown> & { cause: string } }
    | { kind: "forbidden"; stations: string[] }
  )[];
  advice: Advice[];
  /** Null with fewer than four reference points or more than 500, and where the network is not determined without given coordinates. */
  repeated: RepeatedCampaign | null;
}

export interface SuggestedPhoto {
  station: PlanStation;
  /** Value of the criterion with this photo; null if points remain undetermined. */
  value: number | null;
  sees: number;
  compared: number;
}

export interface MakePlanOptions {
  /** Maximum number of photos [40]. */
  most?: number;
}

export interface MadePlan {
  stations: PlanStation[];
  prediction: PlanPrediction;
  compared: number;
  /** Why the search ended; `prediction.lacks` lists what is missing. */
  ended:
    | { why: "reached" | "no_place" | "time" }
    | { why: "most_photos"; most: number }
    /** `tried` more photos gave no improvement. */
    | { why: "no_gain"; tried: number };
}

/** A grey picture, row by row from the top left. */
export interface Picture {
  width: number;
  height: number;
  samples: Uint8Array | Uint16Array;
}

/** A standard error for all points: σ = constant + ppm · 10⁻⁶ · distance from the centre of the list ("2 mm + 2 ppm"). */
export interface SigmaRule {
  constant: number;
  /** Null: that of the coordinates. */
  unit?: Unit | null;
  ppm?: number;
}

/** Choices for reading a list of points, for information that it lacks or to override it. */
export interface ListChoices {
  /** Decimal sign; null: from the rows. With "point", commas are thousands separators. */
  decimal?: "point" | "comma" | null;
  /** Order of the horizontal coordinates of a list without heading; null: X (east) before Y (north). */
  axes?: "xy" | "yx" | null;
  /** Axes of the project that the list is for: the order of a table without heading where `axes` chooses none. */
  project_axes?: "enh" | "neh" | null;
  /** Unit of the coordinates of a list whose heading has none. */
  unit?: Unit | null;
  /** Content of each column, null: not used; overrides heading and content. */
  columns?: (ControlField | null)[] | null;
  /** Encoding of bytes; null: from the content. Ignored for a string. */
  encoding?: TextEncodingName | null;
  /** Field separator; null: from the rows. */
  separator?: "comma" | "semicolon" | "tab" | "blanks" | null;
  /** Line of the first row of points, counted from 1; the row before it is the heading. */
  first_line?: number | null;
  /** Unit of columns of standard errors whose heading has none; null: that of the coordinates. */
  sigma_unit?: Unit | null;
  /** Common standard error of points without one of their own. */
  sigma?: SigmaRule | null;
  /** Local system of latitudes and longitudes (`project.origin.local_system` of earlier lists); null: at the rounded mean of the list. */
  local_system?: LocalSystem | null;
}

/** Choices of reading. */
export interface ImportChoices extends ListChoices {
  /** Width and height of photos by file name, for formats without them (`realitycapture`); a photo given among the files needs none. */
  sizes?: Record<string, [number, number]>;
  /** Accept a camera whose converted model differs by more than 1 px; default false. */
  convert?: boolean;
}

/** Choices of writing. */
export interface ExportOptions {
  /** Accept a camera whose converted model differs by more than 1 px; default false. */
  convert?: boolean;
}

/** A camera model fitted to another one by least squares over a region. */
export interface Conversion {
  camera: string;
  /** Model that was given. */
  from: string;
  /** Model that was fitted. */
  to: string;
  /** Largest difference in the region, pixels. */
  max_px: number;
  rms_px: number;
  /** The region, a polygon of pixels. */
  region: [number, number][];
  /** Whether the difference is larger than 0.05 px. */
  warning: boolean;
}

/** Covariance of parameters. */
export interface ParameterCovariance {
  parameters: string[];
  matrix: number[][];
}

/** Data that the document or the file cannot hold, by name. */
export interface Ignored {
  name: string;
  count: number;
}

/** Assumptions for information that a format lacks. */
export type Assumed =
  | "sigma_one_pixel"
  | "image_size_from_principal_point"
  | "measurements_from_corner"
  | "image_size_from_measurements"
  | "four_coefficients_radial_tangential"
  | "unit_unknown"
  | "pixel_origin_corner"
  | "system_of_chunk";

export type CameraFormat = "opencv" | "ros" | "kalibr" | "mrcal" | "colmap" | "agisoft-lens" | "micmac";
export type CameraImportFormat = "auto" | CameraFormat | "metashape" | "meshroom";
export type CameraExportFormat = CameraFormat;

export interface CameraImportOptions {
  /** Region of the picture in which a model is converted, a polygon of pixels; null: the file's own, else the whole picture. */
  region?: [number, number][] | null;
  /** Accept a difference of more than 1 px; default false. */
  convert?: boolean;
}

export interface CameraExportOptions extends CameraImportOptions {
  /** Covariance of the camera's parameters, written converted as `camera.covariance.json`. */
  covariance?: ParameterCovariance | null;
}

export interface ImportedCamera {
  camera: Camera;
  /** Absent where the model is the document's own. */
  conversion?: Conversion;
  covariance?: ParameterCovariance;
  /** Region of validity according to the file. */
  region?: [number, number][];
  position?: [number, number, number];
  rotation?: [number, number, number];
}

export interface ImportedCameras {
  format: Exclude<CameraImportFormat, "auto">;
  cameras: ImportedCamera[];
  assumed: Assumed[];
  ignored: Ignored[];
}

export interface ExportedCamera {
  files: Record<string, Uint8Array>;
  /** Null where the model is the document's own. */
  conversion: Conversion | null;
  covariance: ParameterCovariance | null;
  ignored: Ignored[];
}

export type Unit = "mm" | "cm" | "m" | "µm" | "dm" | "km" | "in" | "ft" | "ft-us" | "yd";
export type ControlField = "id" | "label" | "X" | "Y" | "Z" | "latitude" | "longitude" | "sX" | "sY" | "sZ" | "sXY" | "sigma" | "role" | "diameter";
export type TextEncodingName = "utf-8" | "utf-16" | "cp949" | "windows-1252";
export type ListFormat = "table" | "leica_gsi" | "sokkia_sdr" | "job_xml" | "land_xml" | "odm_gcp";
/** Basis of an assumption; "undecided": ask the user. */
export type Basis = "heading" | "content" | "given" | "convention" | "undecided";

/** How a list of points was read. */
export type Assumption =
  | { kind: "format"; format: ListFormat; by: Basis }
  /** `by: "convention"`: no other encoding fits. */
  | { kind: "encoding"; encoding: TextEncodingName; by: Basis }
  /** The first row of points, if lines before it are skipped. */
  | { kind: "first_row"; line: number; by: Basis }
  /** Data in the list other than points, which are not imported. */
  | { kind: "beside"; what: "lines_before" | "measurements" | "image_measurements" | "deleted" | "references" | "geographic"; count: number }
  /** Generated names of a list without names: "GCP 1" and so on. */
  | { kind: "names_made"; count: number }
  /** Common standard error of points without one of their own; undecided: the unit of the coordinates must be known first. */
  | { kind: "common_sigma"; rule: SigmaRule; points: number; by: Basis }
  | { kind: "separator"; separator: "comma" | "semicolon" | "tab" | "blanks"; by: Basis }
  | { kind: "decimal_sign"; sign: "point" | "comma"; by: Basis; example?: string }
  | { kind: "columns"; columns: (ControlField | null)[]; by: Basis }
  | { kind: "axis_order"; order: "xy" | "yx"; by: Basis }
  /** Latitudes, longitudes and heights, taken as ellipsoidal, converted to metres; "convention": the origin is the rounded mean of the list. */
  | { kind: "local_system"; system: LocalSystem; form: "degrees" | "sexagesimal"; height_unit: Unit; by: Basis }
  | { kind: "sigma_columns"; columns: number[]; by: Basis }
  | { kind: "unit"; unit: Unit | null; by: Basis }
  /** Columns with unknown headings, which are not used. */
  | { kind: "ignored"; columns: string[] }
  /** Headings with text in round brackets that is neither an axis nor a unit. */
  | { kind: "remarks"; headings: string[] };

/** An imported project with the assumptions made. */
export interface Imported extends Project {
  /** File by file, for `control-csv`. */
  assumptions?: { file: string; assumptions: Assumption[] }[];
  /** The format, for networks of other programs. */
  recognised?: Exclude<ImportFormat, "auto">;
  /** Cameras whose model was converted. */
  conversions?: Conversion[];
  assumed?: Assumed[];
  /** Data of the files that were not imported. */
  ignored?: Ignored[];
}

export type ImportFormat = "sightline" | "package" | "control-csv" | "distances" | "mark-points" | "photomodeler" | "aicon" | "dbat" | "comparator" | "auto" | "colmap" | "metashape" | "bal" | "bundler" | "meshroom" | "nvm" | "opensfm" | "pix4d" | "realitycapture" | "vstars";
export type ExportFormat = "sightline" | "package" | "control-csv" | "mark-points" | "report" | "plots" | "csv" | "tsv" | "spreadsheet" | "spreadsheet-cp949" | "calibration" | "dxf" | "dxf-2010" | "landxml" | "ply" | "gltf" | "colmap" | "colmap-binary" | "metashape" | "bal" | "bundler" | "meshroom" | "vstars" | "opencv";

/** A parameter of a fit. */
export interface Coefficient {
  name: string;
  value: number;
  /** Null without redundancy. */
  sigma: number | null;
}

/** Plate readings transformed to the fiducial marks. */
export interface ReducedFilm {
  /** Camera, photos, points and observations; nothing is oriented. */
  project: Project;
  /** The fit of each photo; residuals in mm, in the order of the marks. */
  inner_orientations: {
    photo: string;
    marks: string[];
    transformation: {
      kind: "similarity" | "affine" | "projective";
      residuals: [number, number][];
      redundancy: number;
      sigma0: number | null;
      matrix: [number, number, number][];
      parameters: Coefficient[];
      origin: [number, number];
    };
  }[];
  /** The odd polynomial of the distortion table (mm, µm), its coefficients and residuals in mm. */
  distortion: {
    table: [number, number][];
    polynomial: { coefficients: Coefficient[]; residuals: number[]; sigma0: number | null };
  } | null;
}

/** The error thrown by every function. */
export interface SightlineError extends Error {
  /** Stable name of the kind of error. */
  code: string;
  where: { file?: string; photo?: string; point?: string; camera?: string; line?: number; field?: string };
  /**
   * The values of the message. Errors with a reason (`invalid`, `broken_image`, `cannot_orient`) have it with its values in `reason`
   * and as a sentence in `detail`.
   */
  data: { code: string; [name: string]: unknown } | null;
}

/** The papers' experiments. */
export type ExperimentName = "kang" | "film" | "lee-calibration" | "lee-structure" | "kim" | "sensor";

/** A point of a coordinate list. */
export interface ListedPoint {
  id: string;
  xyz: [number, number, number];
  /** Standard errors; 0 on an axis: held there. */
  sigma?: [number, number, number] | null;
}

/** Covariance matrix of points, three rows each, squared unit, including σ0². */
export interface ListedCovariance {
  points: string[];
  /** All rows in full, or the lower triangle with the diagonal. */
  matrix: number[][];
}

/** Result of `readList`. */
export interface PointList {
  /** The points read, with their lines. */
  points: (Point & { line: number; label?: string })[];
  /** Lines that could not be read, each with the reason as a sentence and as data. */
  rejected: { line: number; text: string; message: string; error: unknown }[];
  /** Null: ask the user. */
  unit: Unit | null;
  assumptions: Assumption[];
  /** Undecided assumptions: ask the user before using the points, and read again with the answer. */
  undecided: Assumption[];
  /** Words of the heading, column by column; empty without one. */
  heading: string[];
  /** Fields of the first rows, as text. */
  sample: string[][];
}

/** Result of `readCoordinates`. */
export interface CoordinateList {
  points: ListedPoint[];
  /** Unit, if the heading or the caller gives one. */
  unit: string | null;
  assumptions: Assumption[];
}

/** An epoch: a project, or a list of points from another program. */
export interface Epoch {
  /** Unique among the epochs. */
  name: string;
  /** ISO 8601: `2026-03-14`, `2026-03-14T09:30`, `2026-03-14T09:30:00+09:00`. */
  date?: string | null;
  /** °C; reported, not used. */
  temperature?: number | null;
  project?: Project | null;
  /** Null: the project is adjusted with the default options. Without the covariance of all points it is adjusted again. */
  adjustment?: Adjustment | null;
  /**
   * Control points of a project: `released` (default) adjusts it as a free network, since given coordinates are the same in every epoch; use
   * `kept` if they were measured again for this epoch.
   */
  control?: "released" | "kept";
  points?: (Omit<ListedPoint, "id"> & { id: string | number })[] | null;
  covariance?: (Omit<ListedCovariance, "points"> & { points: (string | number)[] }) | null;
  /** Standard deviation of unit weight of the adjustment of a list. */
  sigma0?: number | null;
  /** Its redundancy; null: the standard errors count as exact. */
  redundancy?: number | null;
  /** Unit of a list; null: that of the other epochs. */
  unit?: string | null;
  /** Whether a list has a scale of its own; null: it has. */
  scale?: boolean | null;
}

/** Movement of a group: translation and rotation; plus scale; plus homogeneous strain. */
export type GroupModel = "rigid" | "similarity" | "affine";

/** Thresholds of the displacement length. */
export interface MonitoringLimits {
  warning: number;
  alarm: number;
}

/** Camera motion removed from an uncertainty or a difference. */
export type MotionReference = "rotation" | "rotation_translation" | "photos" | "none";

/** Options of `projectionUncertainty`. */
export interface UncertaintyOptions {
  /** May be left out where the adjustment has one camera. */
  camera?: string | null;
  /** The photo, for a camera with per_photo. */
  photo?: string | null;
  /** Places along width and height, borders included; [25, 17] unless given. */
  grid?: [number, number];
  /** Distance of the points, in the project's unit; null: directions. */
  distance?: number | null;
  /** Region of the motion fit: a disc in the middle of the image, or the whole image. */
  region?: "centre" | "all";
  /** `photos`: the mean motion of the photos relative to the object, which needs no fit (mrcal's mean-pcam). */
  reference?: MotionReference;
}

/** Result of `projectionUncertainty`. Maps are rows of `v` of columns `u`; null if the model gives no ray. */
export interface ProjectionUncertainty {
  camera: string;
  photo?: string;
  /** Parameters included; held parameters count as exact. */
  parameters: Parameter[];
  distance: number | null;
  region: "centre" | "all";
  reference: MotionReference;
  u: number[];
  v: number[];
  /** Standard error in the worst direction, pixels. */
  sigma: (number | null)[][];
  /** uu, uv, vv. */
  covariance: ([number, number, number] | null)[][];
  /** Whether a measurement lies within one step of the grid. */
  covered: boolean[][];
  worst: { u: number; v: number; sigma: number } | null;
  median: number | null;
}

/** Options of `uncertaintyOverDistance`. */
export interface DistanceOptions {
  /** May be left out where the adjustment has one camera. */
  camera?: string | null;
  /** The photo, for a camera with per_photo. */
  photo?: string | null;
  /** Distances in the project's unit; null: 33 in equal ratios, from a fifth of the nearest to five times the farthest distance between a photo and a point measured in it. */
  distances?: number[] | null;
  /** Pixels; null: the image centre and the four points at nine tenths of the way from it to the corners. */
  places?: [number, number][] | null;
}

/** Result of `uncertaintyOverDistance`; the mean motion of the photos relative to the object is removed (`reference: "photos"`). */
export interface DistanceUncertainty {
  camera: string;
  photo?: string;
  /** Parameters included; held parameters count as exact. */
  parameters: Parameter[];
  distances: number[];
  /** Smallest and largest distance between a photo of the camera and a point measured in it. */
  measured: [number, number];
  places: {
    u: number;
    v: number;
    /** Per distance: standard error in the worst direction, pixels; null if the model gives no ray. */
    sigma: (number | null)[];
    /** The same of a direction. */
    infinity: number | null;
  }[];
}

/** Options of `residualBands`. */
export interface BandOptions {
  /** May be left out where the adjustment has one camera. */
  camera?: string | null;
  /** The photo, for a camera with per_photo. */
  photo?: string | null;
  /** Bands across and down: 16 by default. */
  bands?: number;
}

/** Residuals between two columns or rows of the image. */
export interface ResidualBand {
  /** Pixels. */
  from: number;
  to: number;
  /** Measurements that took part. */
  count: number;
  /** Root mean square of a residual, pixels; null without measurements. */
  rms: number | null;
  /** What the standard errors of the measurements let expect, pixels; null without redundancy numbers. */
  expected: number | null;
}

/** Result of `residualBands`. */
export interface ResidualBands {
  camera: string;
  photo?: string;
  columns: ResidualBand[];
  rows: ResidualBand[];
}

/** Options of `compareCameras`. */
export interface DifferenceOptions {
  grid?: [number, number];
  distance?: number | null;
  region?: "centre" | "all";
  reference?: Exclude<MotionReference, "photos">;
}

/** Result of `compareCameras`: image positions of the second camera minus those of the first, pixels. */
export interface CameraDifference {
  u: number[];
  v: number[];
  du: (number | null)[][];
  dv: (number | null)[][];
  /** From the first camera frame to the second, a vector along the axis, radians. */
  rotation: [number, number, number];
  translation: [number, number, number] | null;
  distance: number | null;
  rms_px: number | null;
  max_px: number | null;
}

/** Options of `crossValidate`. `reference` is not `photos`. */
export interface CrossOptions extends DifferenceOptions {
  /** Number of parts of the photos, balanced by position and roll: 2 by default, at most 8. */
  parts?: number;
  /** May be left out where the project has one camera. */
  camera?: string | null;
  /** How each part is adjusted; not with `snooping`, `robust` or `variance_components`, which treat a wrong model as noise. */
  adjust?: AdjustOptions;
}

/** A part of the photos, calibrated separately. */
export interface CrossPart {
  photos: string[];
  sigma0: number | null;
  /** Significant patterns of its residuals (p < 0.001). */
  patterns: PatternKind[];
  camera: AdjustedCamera;
}

/** Result of `crossValidate`. Maps are rows of `v` of columns `u`; null if a part gives no ray. */
export interface CrossValidation {
  camera: string;
  parts: CrossPart[];
  u: number[];
  v: number[];
  /** Standard error of the difference of two parts from the a priori standard errors (not scaled with sigma0, which a wrong model increases), pixels: the root of the sum of both covariances in the worst direction. */
  predicted: (number | null)[][];
  /** Length of the difference after the best rotation, pixels. */
  observed: (number | null)[][];
  /** Observed over predicted; of several pairs of parts the largest. */
  ratio_map: (number | null)[][];
  /** Whether every part has a measurement within one step of the grid. The parts are compared only there. */
  covered: boolean[][];
  /** The covered position with the largest ratio; `sigma` is the prediction there. */
  worst: { u: number; v: number; sigma: number } | null;
  ratio: number | null;
  /** The largest ratio to standard errors that include sigma0. */
  ratio_with_sigma0: number | null;
  /** The ratio that a correct model exceeds anywhere in one of a thousand cases, simulated from the covariances, at least 2; 2 if the residuals of every part have a pattern. */
  limit: number;
  /** `larger_noise`: beyond the limit, but not with sigma0, and no part has a pattern: the a priori standard errors are too small. */
  verdict: "agrees" | "larger_noise" | "wrong_model";
}

/** Name of a camera model. */
export type CameraModelName = "brown" | "opencv" | "opencv_rational" | "opencv_fisheye";

/** Differences after conversion to another camera model. */
export interface ModelConversion {
  camera: string;
  from: CameraModelName;
  to: CameraModelName;
  /** Largest difference of the image positions of one direction; null if the principal distance is unknown. */
  max_px: number | null;
  rms_px: number | null;
  /** Valid share of the picture: a perspective model has no image of rays far from the axis (75 degrees). */
  share: number;
  /** Parameters whose a priori standard error the other model cannot use; those that exist there are estimated without it. */
  dropped: Parameter[];
}

/** Result of `convertCamera`: the camera and the interior orientations of its photos in the other model. */
export interface ConvertedCamera {
  project: Project;
  conversion: ModelConversion;
}

/** Result of `calibrationCoverage`. */
export interface Coverage {
  camera: string;
  /** Photos with measurements that take part. */
  photos: number;
  measurements: number;
  /** Measurements by six rows and eight columns of cells of the picture. */
  cells: number[][];
  /** Measurements by five rings from the middle to the corner. */
  rings: number[];
  /** Radius of the outermost measurement in parts of that of the corner. */
  reach: number;
  /** Photos with a known orientation: of these are rolls, tilts and distances. */
  oriented: number;
  /** Photos by their roll against the first one: 0, 90, 180, 270 degrees. */
  rolls: [number, number, number, number];
  /** Photos by the tilt of their axis against the normal of the points' plane: up to 15, 30, 45 and 90 degrees. */
  tilts: [number, number, number, number];
  distances: [number, number] | null;
  lacks: ("photos" | "radius" | "cells" | "roll" | "tilt")[];
}

/** Options of `compareModels`. */
export interface ModelsOptions {
  /** May be left out where the project has one camera. */
  camera?: string | null;
  /** Seed of the choice of held-out image points: 1. */
  seed?: number;
  /** How each model is adjusted; not with `snooping`, `robust` or `variance_components`, by which every model would choose its own observations. */
  adjust?: AdjustOptions;
}

/** A camera model on the network; `compareModels` gives one each, of the rational model one without and one with K5 and K6. */
export interface ComparedModel {
  model: CameraModelName;
  /** Difference of its initial values from the current camera; null if it could not be converted. */
  conversion: ModelConversion | null;
  /** With its adjusted values and estimated parameters; null if it failed. */
  camera: Camera | null;
  sigma0: number | null;
  /** Estimated. */
  parameters: Parameter[];
  /** Distortion parameters that are not significantly different from 0. */
  insignificant: Parameter[];
  /** Rms error of the coordinates of a fifth of the image points, predicted without them, pixels; null if none could be held out. */
  held_out_rms: number | null;
  /** Bayesian information criterion (Schwarz) minus that of the best model. */
  bic: number | null;
  /** `too_stiff`: it cannot describe the lens; `overfits`: no better than the best, with more parameters. */
  verdict: "best" | "as_good_with_fewer" | "as_good" | "too_stiff" | "overfits" | "failed";
  /** Why it failed, as in `data` of a thrown error. */
  failure: Record<string, unknown> | null;
}

/** Options of `compareEpochs`. */
export interface CompareOptions {
  /** Two or more, in time. */
  epochs: Epoch[];
  /** Null: the control points, else the datum points of the projects, else all common points that are not numbered automatically. */
  reference?: (string | number)[] | null;
  ignored?: (string | number)[];
  /** `joint`: the stable reference points have one set of coordinates; more than two projects, or shared cameras: in one bundle adjustment of all epochs. */
  method?: "coordinates" | "joint";
  /** Cameras with one interior orientation in all epochs; needs `method: "joint"` and projects. None by default: cameras are one per epoch. */
  shared_cameras?: (string | number)[];
  /** 0.05. */
  significance?: number;
  /** Correction for the number of object points. */
  correction?: "holm" | "bonferroni" | "none";
  /** Probability with which a detectable displacement is detected: 0.80. */
  power?: number;
  /** `estimated`: pooled where the variance factors are equal; `separate`: one each; `given`: σ0 = 1 with infinitely many degrees of freedom. */
  variance?: "estimated" | "separate" | "given";
  /** `given`: the epochs are in one system and are not transformed. */
  datum?: "reference" | "given";
  groups?: { name: string; points: (string | number)[]; model?: GroupModel }[];
  thresholds?: (MonitoringLimits & { points?: Record<string, MonitoringLimits>; groups?: Record<string, MonitoringLimits> }) | null;
  /** Names of one of these prefixes and digits were numbered automatically and are matched by position: ["u", "TARGET"]. */
  automatic?: string[];
}

/** A test: passed if the statistic does not exceed the limit. */
export interface MonitoringTest {
  statistic: number;
  f1: number;
  /** Null: infinitely many. */
  f2: number | null;
  /** Corrected for the number of tests where they are corrected. */
  limit: number;
  /** Not corrected. */
  p: number;
  passed: boolean;
}

/** Displacement of a point, later minus earlier, in the system of the first epoch. */
export interface Displacement {
  id: string;
  /** Name in the later epoch, if it was matched by position under another name. */
  later_id?: string;
  role: "reference" | "object";
  /** Coordinates in the earlier epoch, in the system of the first. */
  xyz: [number, number, number];
  difference: [number, number, number];
  sigma: [number, number, number];
  /** xx, xy, xz, yy, yz, zz. */
  covariance: [number, number, number, number, number, number];
  length: number;
  length_sigma: number | null;
  /** Null without a stable group, and of a point held in both epochs. */
  test: MonitoringTest | null;
  moved: boolean;
  /** Confidence ellipsoid at 1 - significance. */
  ellipsoid: { semi_axes: [number, number, number]; directions: [[number, number, number], [number, number, number], [number, number, number]] } | null;
  detectable: Detectable | null;
}

/** Parameters with standard errors, tested against 0. */
export interface TestedParameters {
  value: number[];
  sigma: number[];
  test: MonitoringTest;
}

/** Movement of a group about its centroid in the earlier epoch. */
export interface GroupMovement {
  name: string;
  model: GroupModel;
  points: string[];
  missing: string[];
  centre: [number, number, number] | null;
  translation: TestedParameters | null;
  /** Rotation vector, radians. */
  rotation: TestedParameters | null;
  /** Change of scale. */
  scale: TestedParameters | null;
  /** xx, xy, xz, yy, yz, zz. */
  strain: TestedParameters | null;
  /** Whether it moved. */
  test: MonitoringTest | null;
  /** Test of the fit of the model. */
  fit: MonitoringTest | null;
  residuals: { id: string; difference: [number, number, number]; sigma: [number, number, number] }[];
  /** Null without thresholds. */
  state: "quiet" | "warning" | "alarm" | null;
  error?: { code: "too_few_points"; needed: number; given: number } | { code: "undetermined" } | { code: "no_stable_group" };
}

/** Why a point was not compared. */
export type LeftOutOfPair =
  | { code: "only_in" | "no_sigma" | "no_counterpart" | "no_identity"; epoch: string }
  | { code: "ambiguous"; epoch: string; candidates: string[] }
  | { code: "ignored" | "held" };

/** Notes on the comparison of a pair. */
export type PairNote =
  | { code: "variances_differ" | "scale_differs" | "no_stable_group" | "not_joint" }
  | { code: "too_many_together"; points: number; limit: number }
  | { code: "camera_differs"; camera: string }
  | { code: "sigmas_too_small"; factor: number }
  | { code: "no_majority"; stable: number; reference: number }
  | { code: "another_group" | "second_opinion_differs" | "weakly_controlled"; points: string[] };

/** Comparison of two epochs. */
export interface EpochPair {
  from: string;
  to: string;
  /** Two-sided, later over earlier: the limit is that on the side of the statistic. */
  variance_test: MonitoringTest | null;
  variance: "pooled" | "separate" | "given";
  /** Null where each epoch has its own. */
  sigma0: number | null;
  /** Null: infinite. */
  redundancy: number | null;
  reference_from: "named" | "control" | "datum" | "common";
  /** Lengths of the later epoch over those of the earlier one; null if one has no scale. */
  scale: { value: number; sigma: number; test: MonitoringTest } | null;
  global_test: MonitoringTest | null;
  /** Backward elimination; `test` is that of the remaining points. */
  steps: { removed: string; contribution: number; test: MonitoringTest }[];
  outcome: "congruent" | "stable_group" | "no_stable_group";
  stable: string[];
  unstable: string[];
  /** The datum of smallest displacements, as a second opinion. */
  robust_datum: { stable: string[]; unstable: string[] };
  points: Displacement[];
  groups: GroupMovement[];
  left_out: { id: string; reason: LeftOutOfPair }[];
  notes: PairNote[];
}

/** Files of a comparison of epochs: "dxf" and "gltf" (binary) draw one pair, "report" is a page. */
export type EpochsFormat = "csv" | "json" | "dxf" | "gltf" | "report";

export interface EpochsExport {
  /** Number of the pair that is drawn: 0. */
  pair?: number;
  /** Factor on the lengths of displacements in drawings: 1. */
  factor?: number;
  /** Options of the comparison without its epochs, for the report. */
  options?: Omit<CompareOptions, "epochs">;
  /** Language and paper of the report. */
  settings?: ReportSettings;
}

/** Result of `displacementsInPhotos` for a photo, pixels. */
export interface PhotoDisplacements {
  photo: string;
  /** From the point to its place displaced by the factor; length in the unit of the epochs. */
  vectors: { point: string; from: [number, number]; to: [number, number]; length: number; moved: boolean }[];
  /** Points whose displacement ends where the camera has no image of it at this factor: choose a smaller one. */
  not_drawn: string[];
}

/** Result of `compareEpochs`. */
export interface Monitoring {
  method: "coordinates" | "joint";
  /** One adjustment of all epochs; absent if the epochs were compared in pairs. `test`: one interior orientation against one per epoch, null if nothing of it is estimated. */
  joint?: {
    points: string[];
    cameras: { id: string; test: MonitoringTest | null }[];
    sigma0: number | null;
    redundancy: number;
  };
  unit: string | null;
  /** Letters and order of coordinates, as the first project that says them. */
  axes?: "enh" | "neh";
  epochs: {
    name: string;
    date: string | null;
    temperature: number | null;
    sigma0: number | null;
    redundancy: number | null;
    points: number;
    scaled: boolean;
    notes: ({ code: "no_covariance" | "no_redundancy" } | { code: "control_released"; points: string[] })[];
  }[];
  /** Every epoch with the first, then every one with its predecessor. */
  pairs: EpochPair[];
  series: {
    id: string;
    values: { epoch: string; difference: [number, number, number]; sigma: [number, number, number] }[];
    /** Unit per day; null below three dated epochs, and without a common datum. */
    velocity: [number, number, number] | null;
    velocity_sigma: [number, number, number] | null;
    /** Displacement of the straight line at the earliest date. */
    line_start: [number, number, number] | null;
    velocity_test: MonitoringTest | null;
    /** By the length of the last displacement; null without thresholds. */
    state: "quiet" | "warning" | "alarm" | null;
  }[];
  /** Reference points stable in all pairs with the first epoch; empty if fewer than four are. */
  series_datum: string[];
}

/** Inputs of an experiment; defaults are the paper's values. */
export interface ExperimentOptions {
  /** Seed of all noise. */
  seed?: number;
  /** Standard deviation of image coordinates, µm (kang, film, lee-structure). */
  image_sigma_um?: number | null;
  /** Standard deviation of the pixels' noise, share of full scale (lee-calibration, kim, sensor). */
  pixel_noise?: number | null;
  /** Standard error of control coordinates, mm (kang, lee-structure, kim). */
  control_sigma_mm?: number | null;
  /** Monte Carlo runs (kang). */
  rounds?: number | null;
  /** Network of the project to open: "1.4-5A", "H'" (kang), "I-free" (lee-structure). */
  network?: string | null;
  /** Photos left out of the second run (lee-calibration). */
  left_out?: string[] | null;
  /** How centres are measured for the adjustment (lee-calibration). */
  method?: "least_squares" | "ellipse" | "intensity" | "gradient" | null;
  /** Progress callback; return `false` to cancel. */
  on_progress?: (done: number, of: number) => void | boolean;
}

/** An item to draw: a point with its role, or a photo with its viewing direction. */
export interface Drawn {
  id: string;
  xyz: [number, number, number];
  direction?: [number, number, number];
  role?: "tie" | "control" | "check";
}

/** An axis of a chart with ticks; group ticks are in a second row. */
export interface Axis {
  id: string;
  unit: string;
  ticks: { at: number; text: string; group: boolean }[];
}

/** Result of an experiment. Cells are numbers, names or null; `paper` marks figures of the paper. */
export interface Experiment {
  name: ExperimentName;
  drawings: { id: string; unit: string; points: Drawn[]; photos: Drawn[] }[];
  figures: { id: string; unit: string; ours: number; paper: number | null; independent: number | null }[];
  tables: {
    id: string;
    columns: { id: string; unit: string; decimals: number; paper: boolean }[];
    rows: (number | string | null)[][];
  }[];
  charts: {
    id: string;
    x: Axis;
    y: Axis;
    /** Pieces of a broken line share their id. */
    series: { id: string; paper: boolean; points: [number, number][] }[];
  }[];
  /** Assumptions that are missing in the paper or differ from it. */
  assumptions: { id: string; unit: string; ours: number | null; paper: number | null }[];
  /** Ready to be opened and adjusted. */
  project: Project;
}
