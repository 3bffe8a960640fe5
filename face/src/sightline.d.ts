/** Name of a parameter of the interior orientation; "f" stands for fx and fy as one. */
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

/** A colour that a lens images otherwise than green. */
export type LensColour = "red" | "blue";

/** Differences of a camera's parameters for a colour, in their own units, with their standard errors where known. */
export interface ColourDifferences {
  /** `f` moves fx and keeps the ratio fy : fx. */
  parameters: Partial<Record<Parameter, number>>;
  sigma?: Partial<Record<Parameter, number>>;
}

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
  /** Whether every photo has an interior orientation of its own. */
  per_photo?: boolean;
  /** What is added to the parameters for photos measured in another colour than the camera is calibrated in; held. */
  colours?: Partial<Record<LensColour, ColourDifferences>>;
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
  /** SHA-256 of the file in hexadecimal digits, where it was looked into. */
  sha256?: string;
  /** Colour that its centres were measured in, where that is red or blue; null: the one its camera is calibrated in. */
  colour?: LensColour | null;
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
   * Normal of the target's plane in the object system, of any length and either sign; null: that of the surface which its
   * neighbours show. Used where there is a diameter.
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
  /** Number of the photo's target whose centre it is. */
  target?: number | null;
}

export interface Distance {
  from: string | number;
  to: string | number;
  length: number;
  sigma: number;
  /** Compared only, takes no part [false]. */
  check?: boolean;
}

/** A section of the report. */
export type ReportSection =
  | "summary" | "uncertainty" | "observations" | "cameras" | "network" | "photos" | "points" | "control" | "lengths" | "statistics" | "residuals"
  | "gross_errors" | "features" | "settings" | "all_observations";

/** What the report says besides its numbers; no input of the adjustment. */
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
  /** Of expanded uncertainties [2]. */
  coverage_factor?: number;
  /** The largest length measurement error that is permitted: constant + length / per, in the project's unit. */
  length_limit?: { constant: number; per?: number | null } | null;
  /** Colours that were measured apart, photo by photo: told with their cameras. */
  colours?: PhotoColours[];
}

/** How far a lens images a colour from green: pixels outwards at the picture's corner. */
export interface ColourShift {
  /** Part that grows with the radius. */
  linear: number;
  /** Part that grows with its third power. */
  cubic: number;
  /** Standard error of both together. */
  sigma: number;
  /** Rms of what is left of a target's difference. */
  rms: number;
  /** Targets that it is from. */
  targets: number;
  /** Shift of the whole picture, to the right and downwards. */
  shift?: [number, number];
  /** Covariances of shift, linear and cubic part, square pixels: the upper triangle, row by row. */
  covariance?: number[];
}

/** Lateral chromatic aberration as the targets of one photo show it. */
export interface PhotoColours {
  photo: string | number;
  /** Radius of the picture's corners in pixels. */
  corner: number;
  /** Middle of the picture, from which radii count. */
  centre?: [number, number];
  red?: ColourShift | null;
  blue?: ColourShift | null;
}

export interface Datum {
  kind: "control" | "minimal" | "free";
  points?: (string | number)[] | null;
}

/** The document. Fields may be left out where they are optional; what the engine returns has them all. */
export interface Project {
  format: "sightline";
  version: 1;
  name?: string;
  unit?: string;
  cameras?: Camera[];
  photos?: Photo[];
  points?: Point[];
  observations?: Observation[];
  distances?: Distance[];
  datum?: Datum;
  /** Observations that the last orientation disabled, with the reason; the next one looks at them anew. */
  set_aside?: {
    photo: string;
    point: string;
    /** undecided: as many observations of the point speak for another place as for this one. */
    reason: "disagrees" | "photo_not_oriented" | "point_not_determined" | "undecided";
    /** Distance from where the point should have been. */
    distance_px?: number | null;
    /** ["orientation"] */
    by?: "orientation" | "matching";
  }[];
  /** What is measured on every result of this document. */
  features?: Feature[];
  /** Coordinate systems laid through every result. */
  systems?: CoordinateSystem[];
  /** Lines between points, for drawings. */
  lines?: { from: string | number; to: string | number; layer?: string }[];
  /** Layers of the lines; `colour` is red, green, blue, 0 to 255. */
  layers?: { id: string | number; colour: [number, number, number] }[];
  report?: ReportSettings;
  /** What was planned before the photos were taken. */
  plan?: Plan;
  /** The project whose later epoch this is, with this one's number in the series. */
  epoch?: { name: string; key?: string; number: number; names?: Record<string, string> };
  /** Files of another program that the project was read from. */
  origin?: Origin;
}

/** Files of another program that were read: what was assumed, left out and converted. It is no input of the adjustment. */
export interface Origin {
  format: string;
  files?: string[];
  assumed?: Assumed[];
  ignored?: Ignored[];
  conversions?: Conversion[];
}

/** An end of a distance or a side of an angle. */
export type End = { point: string | number } | { feature: string | number };

/** A point with coordinates of another system; `sigma` is its weight, left out where all weigh alike. */
export interface GivenPoint {
  id: string | number;
  xyz: [number, number, number];
  sigma?: [number, number, number] | null;
}

/**
 * A named feature. Forms are of least squared distances from their points: a line from 2 on, a plane or a circle from 3, a sphere from
 * 4, a cylinder from 6. Of two planes the distance is that of the second's centroid from the first, of a line and a plane that of the line's
 * centroid, of lines parallel within 5° that of the second's centroid. An angle is at the place `at` (0 to 180°), or between directions of lines and axes and normals of planes and circles (0
 * to 90°). Deviations are from a form (positive outside, or on the side of the normal) or from `given` coordinates of the same names.
 */
export type Feature = { id: string | number } & (
  | { kind: "line" | "plane" | "circle" | "sphere" | "cylinder"; points: (string | number)[] }
  | { kind: "distance"; from: End; to: End }
  | { kind: "angle"; from: End; at?: End | null; to: End }
  | { kind: "deviations"; points?: (string | number)[]; feature?: string | null; given?: GivenPoint[] }
);

/**
 * A named coordinate system. automatic: Z the normal of the points' plane towards the photos, X their longer extent, the origin their centroid.
 * plane_line_point (3-2-1): Z is 0 in the plane, Y on the line, X at the point. best_fit: of least weighted squares to given coordinates.
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
  /** Points that it was computed from. */
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
  /** Smallest and largest of them. */
  range: [number, number] | null;
  residuals?: FeatureResidual[];
  /** What is drawn: ends of a distance, sides of an angle about its place, ends of a line or an axis. */
  ends?: [number, number, number][];
  /** Why it has no standard errors though there are statistics: it, or what it is measured from, is so weakly determined that they mean
   * nothing. Standard error of the radius over the radius, or of the direction in radians. */
  weak?: number;
  /** Rms over the largest extent of the points, where it is above 0.02: they hardly form what was fitted to them. */
  misfit?: number;
  /** Its points that this adjustment has not. */
  missing?: string[];
  /** Why there is no result. */
  error?: { code: string; [name: string]: unknown };
}

/** A coordinate system laid through a result: x' = scale * rotation * x + shift. */
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
  /** All adjusted points in it. */
  points: { id: string; xyz: [number, number, number]; sigma?: [number, number, number] }[];
  missing?: string[];
  error?: { code: string; [name: string]: unknown };
}

/** What `measureFeatures` gives. */
export interface Measured {
  features: MeasuredFeature[];
  systems: MeasuredSystem[];
}

/** Points that lie at given coordinates. */
export interface Renaming {
  /** Present name, given name, distance. */
  pairs: [string, string, number][];
  /** Given points that are not the only ones near one point, or have several near them. */
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
  /** Rows D of the datum's constraints; none under control. */
  constraints: SparseMatrix;
  redundancy: number;
}

/** Normal equations N d = b, and S d_r = b' after elimination of the points. */
export interface NormalEquations {
  blocks: { name: string; kind: "photo" | "camera" | "point"; first: number; size: number; eliminated: boolean }[];
  N: SparseMatrix;
  b: number[];
  /** `unknowns` are the places of its unknowns among all. */
  reduced: { unknowns: number[]; S: SparseMatrix; b: number[] };
  /** Blocks in the order in which they are eliminated. */
  elimination_order: number[];
  /** Entries of the lower triangle: of N, of its Cholesky factor, and of the factor with the photos eliminated first. */
  fill_in: { matrix: number; factor: number; factor_photos_first: number };
  rank: number;
  /** Movements that no observation sees; rotations and scale about the object's centre. */
  null_space: { name: string; vector: number[] }[];
}

/** An adjustment that is run step by step. */
export interface Adjuster {
  /** Takes one step and gives the state after it; nothing changes after the last one. */
  step(): StepState;
  /** Goes back by one step and gives the state there; stays at the initial values. */
  back(): StepState;
  /** The present state. */
  state(): StepState;
  /** The whole adjustment, as `adjust` gives it. */
  finish(): Adjustment;
}

/** State of an adjustment after a step. */
export interface StepState {
  step: number;
  /** The project with the present values as initial values. */
  project: Project;
  /** The iteration that led here. */
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
  /** Scale of robust weights: estimated and never below the a priori standard errors, or estimated wherever it falls ["at_least_prior"]. */
  robust_scale?: "at_least_prior" | "estimated";
  /** [false] */
  snooping?: boolean;
  /**
   * Where the brown model's residuals are taken: in the measurement, where the weights belong, or at the corrected place as other programs do, to compare
   * with them ["measured"].
   */
  residuals?: "corrected" | "measured";
  /** Estimates the variances of image coordinates, control and the rest until sigma0 is 1; not with robust weights [null]. */
  variance_components?: null | { per_camera?: boolean; unmodelled?: boolean };
  /** Standard deviation of what is not modelled, added in quadrature to that of every image coordinate, pixels [0]. */
  unmodelled?: number;
  /** Diameter of the circular targets that state none of their own, in the project's unit: frees them of their eccentricity [null]. */
  target_diameter?: null | number;
  /** Points whose full covariance matrix is wanted [none]. */
  covariance_of?: string[];
  /** Called after every iteration; returning false stops. */
  on_iteration?: (iteration: Iteration) => void | boolean;
}

export interface Correlation {
  names: string[];
  matrix: number[][];
}

export interface AdjustedCameraResult {
  /** The photo whose own interior orientation this is. */
  photo?: string;
  /** Standard errors of the estimated parameters. */
  sigma: Partial<Record<Parameter, number>>;
  /** The a priori ones of the document's camera; absent where there are none. */
  sigma_a_priori?: Partial<Record<Parameter, number>>;
  /** Size of each estimated parameter of distortion in standard errors. */
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
   * Residuals in the photo's unit. Of an observation that took no part: what it says beside the adjusted values; null where photo or
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
  /** External reliability: how far a bias of that size, undetected, moves the point, in the project's unit and datum. */
  effect_x: number | null;
  effect_y: number | null;
  /** Factor on the weight from robust weighting; absent where it is 1. */
  weight?: number;
  enabled: boolean;
}

/** An observation of another kind than image coordinates. */
export type GivenObservation = {
  /** Null where what was observed is not adjusted. */
  residual: number | null;
  sigma: number;
  reliability: { redundancy: number; w: number | null; mdb: number | null } | null;
  /** External reliability: how far a bias of that size, undetected, moves the point that it moves most, in the project's unit. */
  effect: number | null;
  /** That point: the control point itself, an end of the distance, a point of the photo, a point the camera sees. */
  effect_point: string | null;
  /** Factor on the weight from robust weighting; absent where it is 1. */
  weight?: number;
  /** False where data snooping took it out; the residual is then beside the adjusted value. */
  enabled: boolean;
} & Given;

/** Kinds of observations besides image coordinates; axis 0, 1, 2 for X, Y, Z. */
export type Given =
  | { kind: "control"; point: string; axis: number }
  | { kind: "position"; photo: string; axis: number }
  | { kind: "distance"; from: string; to: string }
  | { kind: "parameter"; camera: string; photo: string | null; parameter: Parameter };

/** What the search for gross errors did with an observation. */
export interface GrossError {
  /** Empty for observations without one. */
  photo: string;
  /** Empty for observations without one. */
  point: string;
  /** What was observed; null for image coordinates. */
  given: Given | null;
  action: "removed" | "restored" | "downweighted" | "kept";
  statistic: number;
  limit: number;
  round: number;
  /** Whether it went only because another did: its point was left with this one ray. */
  consequence: boolean;
}

/**
 * What the residuals of a camera depend on: the radius (lens distortion), a tangential pattern (decentring), affinity and shear, the row or
 * the column (rolling shutter), the position in the image, or single photos (refocused, cropped, of another size).
 */
export type PatternKind = "radius" | "tangential" | "affine" | "row" | "column" | "position" | "photo";

/** What to do about a pattern of the residuals. */
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
  /** How many photos were tested one by one: kinds row, column and photo. Of very large networks it is a part of them. */
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

/** The parameters of a camera that are hardly told apart, or those of a photo from its camera's. */
export interface CorrelationGroup {
  camera: string;
  /** Where one parameter of each pair is the photo's, or the interior orientation is. */
  photo: string | null;
  /** The largest correlation first. */
  pairs: { first: string; second: string; correlation: number }[];
  /** The parameter that is held at the least cost; null where neither of the first pair is a camera's. */
  hold: Parameter | null;
}

/** What a solvable network is weak in. */
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
  /** The residuals of a camera are systematic: what they depend on, and what to do. Stands before anything that takes them as noise. */
  | {
      kind: "residual_pattern";
      camera: string;
      pattern: PatternKind;
      /** Photos that it is about; empty: all. */
      photos: string[];
      p_value: number;
      rms_px: number;
      max_px: number;
      /** sigma0 without the pattern. */
      sigma0: number;
      remedy: Remedy;
    }
  /** The global test failed with a sigma0 beyond its limit; `unmodelled` would make the residuals agree, pixels. */
  | { kind: "sigmas_too_small"; sigma0: number; unmodelled: number | null }
  /** The test fails although `unmodelled` was given: this value instead. */
  | { kind: "unmodelled_again"; sigma0: number; unmodelled: number }
  /** A parameter of distortion that is not told from 0, and the one it is most correlated with. */
  | {
      kind: "insignificant";
      camera: string;
      photo: string | null;
      parameter: Parameter;
      ratio: number;
      with: Parameter | null;
      correlation: number | null;
    }
  /** Observations whose |w| exceeds the critical value, told where the largest is too large for one of so many: image observations with the
   * largest (at most 20), others. */
  | { kind: "suspected"; count: number; observations: [string, string, number][]; given: [Given, number][] }
  /** Given minus where everything else sees the point, and its size in standard errors of the difference. */
  | { kind: "control_misfit"; point: string; difference: [number, number, number]; sigma_ratio: number }
  /** Two control points whose coordinates fit when they are exchanged. */
  | { kind: "exchanged_points"; points: [string, string] }
  /** Points nearer to each other than their standard errors tell apart. */
  | { kind: "double_points"; pairs: [string, string][] }
  | ({ kind: "mirrored_control" } & MirroredControl)
  | ({ kind: "undecided_axes" } & UndecidedAxes)
  | ({ kind: "unit_ratio" } & UnitRatio)
  | ({ kind: "one_station" } & OneStation)
  | ({ kind: "implausible_camera" } & ImplausibleCamera)
  /** Nothing gives a scale: lengths are right relative to each other only and have no unit. */
  | { kind: "no_scale" };

/** An item of the input that took no part in the adjustment. */
export interface LeftOut {
  /** control: a control point, or one of its coordinates (`given` has the axis). */
  kind: "observation" | "control" | "distance" | "point" | "photo" | "position" | "parameter";
  photo?: string;
  point?: string;
  /** What was observed, of other kinds than image coordinates: ends of a distance, axis of a coordinate. */
  given?: Given;
  /** document: somebody disabled it; adjustment: what it depends on did not take part. */
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
  /** Image observations: distance from where the adjusted values place it. */
  size_px?: number;
  /** Others: adjusted minus given; of a control point the distance of the given coordinates from where the photos see it. */
  size?: number;
  /** The same in standard errors of the difference; absent without statistics. */
  size_sigma?: number;
}

/** Two axes exchanged, or one with the other sign. */
export type Exchange = "xy" | "xz" | "yz" | "x" | "y" | "z";

/** Given coordinates are a mirror image of what the photos show. `exchange` undoes it; `alternatives` would as well, and photos and sizes of
 * coordinates do not tell which it was. Standard deviations of a coordinate in the similarity of both, project unit. */
export interface MirroredControl {
  exchange: Exchange;
  alternatives?: Exchange[];
  rms_given: number;
  rms_exchanged: number;
  points: number;
}

/** Given points lie in a plane, and nothing tells whether their axes are mirrored. With the axes as given the cameras stand on the side that
 * `normal` points to. */
export interface UndecidedAxes {
  points: number;
  normal: [number, number, number];
}

/** Something is `ratio` times as long as the rest implies, about as much as two units differ (`nearest`: 1000, 25.4, 304.8, 10, 12, 100 ...
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

/** Photos taken from one place; all of them: there is no depth and no principal distance. */
export interface OneStation {
  photos: string[];
  all: boolean;
}

/** A camera that cannot be what it is said to be; orientation does not use it as given. */
export type ImplausibleCamera = { camera: string } & (
  /** Along the longer side, radians; below 1° or above 150°. `pixels`: the camera has no pixel pitch, so that `value` counts pixels. */
  | { reason: "field_of_view"; angle: number; value: number; pixels: boolean }
  /** Photos with measurements outside of the camera's pictures; largest u and v. */
  | { reason: "image_size"; photos: string[]; size: [number, number]; measured: [number, number] }
  /** A photo of `factor` times the camera's size. */
  | { reason: "resized"; photo: string; factor: number }
  /** A photo that is the part of a picture that begins at `offset`, pixels. */
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
  /** Factor on the a priori standard errors of the group, and its standard error; null where too little checks the group. */
  factor: number;
  factor_sigma: number | null;
  /** Standard deviation of what is not modelled, pixels; null unless asked for. */
  unmodelled: number | null;
  unmodelled_sigma: number | null;
  /** Of image coordinates: root mean square of the a priori standard errors that the factor belongs to, pixels. */
  a_priori_px: number | null;
  /** Why nothing was estimated of the group, whose a priori standard errors stay; null where it was. */
  not_estimated: null | { kind: "little_redundancy"; needed: number } | { kind: "no_residuals" };
}

/** By what observations, parameters and the network are judged. */
export interface Criteria {
  /** Two-sided error probability of the tests on single observations. */
  alpha: number;
  /** Power with which a minimal detectable bias is found. */
  power: number;
  /** Two-sided error probability of the global test. */
  global_alpha: number;
  /** Critical value of Baarda's |w|. */
  w: number;
  /** Critical value of Pope's |tau|; null with a redundancy below 2. */
  tau: number | null;
  /** Non-centrality of minimal detectable biases. */
  noncentrality: number;
  /** Observations with a smaller redundancy number are checked by nothing. */
  unchecked: number;
  /** Observations with a smaller redundancy number are hardly checked. */
  low_redundancy: number;
  /** Parameters with a larger |correlation| are hardly told apart. */
  high_correlation: number;
  /** Rays that meet under a smaller angle determine no depth, radians. */
  narrow_intersection: number;
  /** Parameters of distortion below so many of their standard errors are not told from 0. */
  significance: number;
  /** A sigma0 beyond this, with the global test failed: the standard errors are too small. */
  sigma0: number;
}

/** The result; no number in it is NaN or infinite. */
export interface Adjustment {
  /** What was asked for. */
  options: Required<Omit<AdjustOptions, "on_iteration">>;
  termination: "converged" | "iteration_limit" | "diverged" | "stopped";
  iterations: Iteration[];
  observations_count: number;
  unknowns: number;
  constraints: number;
  redundancy: number;
  /** Null where the redundancy is 0. */
  sigma0: number | null;
  /** Null where the redundancy is 0, and where variance components were estimated, which make the statistic the redundancy. */
  global_test: { statistic: number; lower: number; upper: number; passed: boolean } | null;
  /** Rms of the residuals of all image coordinates that took part, pixels. */
  rms_px: number | null;
  criteria: Criteria;
  cameras: AdjustedCamera[];
  photos: AdjustedPhoto[];
  points: AdjustedPoint[];
  /** In the project's order; the rows are made when they are first read. */
  observations: AdjustedObservation[];
  check_points: { id: string; difference: [number, number, number] | null }[];
  /** Distances that are compared only, adjusted minus given; sigma from the full covariance of their ends. */
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
  /** Every target with a diameter: its largest correction in pixels, null where its normal is not known. There when a target has a diameter. */
  eccentricity?: { point: string; correction_px: number | null }[];
  /** There when asked for. */
  variance_components?: VarianceComponent[];
  /** Tests of the image residuals for patterns; missing without full statistics, and where the iteration did not converge. */
  patterns?: ResidualPattern[];
  advice: Advice[];
  /** Its `high_correlation` entries in groups; missing without any. */
  correlation_groups?: CorrelationGroup[];
  /** Every item of the input that took no part; empty when all took part. */
  left_out: LeftOut[];
  /** Of the points asked for, three rows each in their order. */
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

/** One way to read a ring; its margin is 0 where the reading is doubtful within its family. */
export interface CodeCandidate {
  family: CodeFamily;
  number: number;
  margin: number;
}

/** A family's codes in the order in which they should be used. */
export interface CodeSpread {
  /** All numbers of the family, those with the largest mutual distance first. */
  numbers: number[];
  /** How many of the first numbers differ from each other, however they are turned, in at least so many sectors; descending. */
  counts: { distance: number; codes: number }[];
}

export interface DetectOptions {
  /** ["least_squares"] */
  method?: "least_squares" | "ellipse" | "intensity" | "gradient";
  /** ["auto"] */
  polarity?: "auto" | "bright" | "dark";
  /** ["grey"] the luma plane of a colour JPEG as stored; of other colour pictures 0.2126 R + 0.7152 G + 0.0722 B */
  channel?: "grey" | "red" | "green" | "blue";
  /** Which ring codes are read; "auto": those of the one family that explains every ring of the photo ["none"] */
  codes?: "none" | CodeFamily | "auto";
  /** Smallest full axis of a target in pixels, its minor axis [5]. */
  min_diameter?: number;
  /** Largest full axis of a target in pixels [400]. */
  max_diameter?: number;
  /** Smallest ratio of a target's axes, 0.15 to 1: the cosine of the steepest view that is measured [0.29]. */
  min_axis_ratio?: number;
}

/** How good a target's image is. */
export interface Quality {
  fit_rms: number;
  noise: number;
  edge_width: number;
  saturated: number;
  roundness: number;
  occluded: number;
  /** Safety of the code reading, 0 (a coin toss) to 1; null where no ring was seen. */
  code_margin: number | null;
  /** Why a ring was seen but not read. */
  code_note: "all_set" | "no_code" | "disturbed" | "between_levels" | "other_family" | "uncertain" | "several_families" | "unread" | null;
}

/** The inner rim of a donut: pixels, radians; major and minor are the ellipse's full axes. */
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
  /** Number in its photo, from 1; 0 for a target measured by itself. */
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
  /** The codes that the ring may be where it is not safely one, and under "auto" those of other families; margin 0 where in doubt. */
  code_candidates: CodeCandidate[];
  /** The rim of a hole in it: of a donut the outer rim is the target. */
  inner?: InnerRim;
  quality: Quality;
}

export type RejectionReason =
  | "too_small" | "too_large" | "not_an_ellipse" | "too_flat" | "low_contrast" | "touching" | "saturated" | "at_border" | "occluded"
  | "code_ring" | "no_fit";

/** What a picture shows of how it was taken and processed. */
export interface PictureReport {
  /** Amount of the unsharp mask that its edges show, 0 where none is seen, and the sigma of its mean in pixels. */
  sharpening: number;
  sharpening_radius: number;
  /** Share of samples at either end of the scale, 0 to 1. */
  clipped_dark: number;
  clipped_bright: number;
  /** How much larger differences are across the borders of blocks of eight than elsewhere, as a share. */
  compression: number;
  /** Standard deviation of single samples in grey levels. */
  noise: number;
  /** Standard errors of centres over those that white noise would give; 1 where neighbours share none. */
  noise_correlation: number;
  /** Whether the standard errors take the noise of neighbours as independent (every method but least squares): too small of a compressed picture. */
  white_noise_assumed: boolean;
  /** Whether the picture was searched and measured softened as well. */
  softened: boolean;
}

/** Colour of a filter of a sensor. */
export type Colour = "red" | "green" | "blue" | "cyan" | "magenta" | "yellow" | "white" | "emerald";

/** A sensor's own samples that were measured on; levels and noise in these samples. */
export interface MeasuredSamples {
  /** "sites": each site by itself; "interpolated_sites": a picture between them, for methods other than "least_squares". */
  on: "sites" | "interpolated_sites";
  format: string;
  colour: Colour | null;
  /** Filters, one letter a site, row by row. */
  pattern: string | null;
  bits: number;
  /** The part of the grid that light reaches: left, top, width, height. Coordinates are on the whole grid. */
  active_area: [number, number, number, number] | null;
  /** Sample from which one is clipped. */
  white: number | null;
  /** Growth of a sample's variance with the light in it. */
  gain: number | null;
  /** Standard deviation of a sample without light; null where nothing dark tells. */
  read_noise: number | null;
  /** Sites that shine by themselves. */
  hot_sites: number | null;
  /** Corrections of the lens that the file names, in its own words; none was made. */
  corrections: string[];
  /** Lists of corrections in the file that could not be read: what they name is not known. */
  unread_corrections: number;
}

/** Lateral chromatic aberration of a colour against green. */
export interface Lateral {
  /** Shift of the whole picture, in pixels. */
  shift_u: number;
  shift_v: number;
  /** Parts that grow with the radius and with its third power, in pixels at the corner; positive outwards. */
  linear: number;
  cubic: number;
  /** Both together, and its standard error. */
  at_corner: number;
  sigma_at_corner: number;
  /** What is left of a difference: in pixels, and in units of its standard errors. */
  rms: number;
  sigma0: number;
  /** Targets that it is from. */
  targets: number;
  /** Covariances of `shift_u`, `shift_v`, `linear` and `cubic`, square pixels: the upper triangle, row by row. */
  covariance: number[];
}

/** Targets in red or blue, less the same in green. */
export interface ColourApart {
  colour: Colour;
  /** Centre in green, difference, its standard errors: in pixels. */
  shifts: { u: number; v: number; du: number; dv: number; sigma_u: number; sigma_v: number }[];
  /** Null where there are too few targets. */
  lateral: Lateral | null;
}

export interface ColoursApart {
  /** Middle of the lit part, from which radii count, and the radius of its corners. */
  centre: [number, number];
  corner: number;
  /** Red and blue; empty for a sensor without filters. */
  colours: ColourApart[];
}

export interface Detection {
  width: number;
  height: number;
  bits: number;
  /** Rows that could not be decoded and were not measured: first row and the row after the last. Empty for a sound file. */
  damaged_rows: [number, number][];
  /** Which picture of the file was measured, where a TIFF has several: its number from 1, how many there are, reduced copies and masks passed over. */
  page?: { number: number; of: number; skipped: number };
  picture: PictureReport;
  /** What was measured on, where it is a sensor's own samples (RAW). */
  measured?: MeasuredSamples;
  targets: Target[];
  rejected: Partial<Record<RejectionReason, number>>;
  /** Made when they are first read. */
  rejected_blobs: { u: number; v: number; diameter: number; reason: RejectionReason }[];
}

/** What a photo's file says; null where it says nothing. */
export interface PhotoInfo {
  width: number;
  height: number;
  bits: number;
  make: string | null;
  model: string | null;
  focal_length_mm: number | null;
  focal_length_35mm: number | null;
  pixel_pitch: [number, number] | null;
  /** How the stored grid has to be turned for showing, 1 to 8. */
  orientation: number;
  date: string | null;
  /** What the maker's note says of corrections of the lens. */
  corrections?: LensCorrection[];
}

/** A correction of the lens that a maker's note speaks of: made, not made, or made where the camera knows the lens. */
export interface LensCorrection {
  aberration: "distortion" | "lateral_colour" | "vignetting" | "diffraction";
  setting: "off" | "on" | "auto";
  /** Whose tag says so, as "Sony 0x2013". */
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
  reason: "duplicate_code" | "code_family" | "code_unclear" | "ambiguous" | "disagrees";
}

export interface NameCodedOptions {
  /** Family of the codes [null: the one that alone explains every ring of all photos]. */
  family?: CodeFamily | null;
}

export interface Coded {
  points: Point[];
  observations: Observation[];
  doubtful: Doubtful[];
  /** The family whose codes were taken. */
  family: CodeFamily | null;
  /** The families that explain every ring; several when one has to be chosen, none when the rings are of different ones. */
  families: CodeFamily[];
}

/** An approximate measurement: a point seen at a place of a photo. */
export interface Mark {
  photo: string;
  point: string;
  u: number;
  v: number;
  sigma: number;
}

export interface MatchOptions {
  /** Largest distance of a target from where its point should appear, pixels [null: from the residuals]. */
  tolerance_px?: number | null;
  /** Fewest rays of a new point [3]. */
  min_rays?: number;
}

export interface Matching {
  /** New points, with coordinates. */
  points: Point[];
  /** New observations, of new points and of points that were there. */
  observations: Observation[];
  doubtful: Doubtful[];
}

/**
 * A board of circular dots. Its coordinates: the first dot at (0, 0, 0), x along its row, y down the rows, z away from who looks at it.
 * Dot (i, j) of row i and column j stands at (j, i) pitches on a symmetric board and at (2 j + i mod 2, i) on an asymmetric one.
 */
export interface Board {
  rows: number;
  /** Dots in each row. */
  columns: number;
  /** Distance of two rows, in the unit of the project; the dots of a row of an asymmetric board are two pitches apart. */
  pitch: number;
  kind?: "symmetric" | "asymmetric";
  /** Diameter of the dots: goes to the points, and tells this board from others [null]. */
  diameter?: number | null;
  /** Standard error of a dot's coordinates: control points, 0 holds them [null: tie points at the board's coordinates]. */
  sigma?: number | null;
  /** Place (x, y) on the board of an additional target that shows which corner is the first [null]. */
  mark?: [number, number] | null;
}

export interface GridOptions {
  /** By photo, the pixel of the board's first dot, for boards that look the same when turned; one photo is enough for all [{}]. */
  first?: Record<string, [number, number]>;
}

export interface GridNaming {
  /** What the names begin with: "", or "b2-", "b3-" where the project has other points of these names. Then rowcolumn from 1: "r3c5". */
  prefix: string;
  /** Dots that the project has no point for. */
  points: Point[];
  /** Observations that the project does not have. */
  observations: Observation[];
  named: {
    photo: string;
    dots: number;
    /** Dots of the board that the photo does not show. */
    missing: number;
    /** Dots that were observed under another name before and keep it. */
    named_before: number;
    /** "assumed": the board looks the same when turned, and that turn was taken whose rows run to the right. */
    orientation: "unique" | "mark" | "given" | "assumed";
    /** Turns under which the board looks the same. */
    turns: number;
    /** Whether ground without dots told the place on the board. */
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
  /** Photos in which epipolar lines are wanted [null: all]. */
  lines_in?: string[] | null;
}

/** Where a point should be, from the rays it has. */
export interface Prediction {
  point: string;
  /** Oriented photos in which it is measured and takes part. */
  rays: number;
  /** Null below two rays, or where they do not meet. */
  xyz: [number, number, number] | null;
  /** Null where a photo that sees it has no standard errors of its orientation. */
  sigma: [number, number, number] | null;
  /** Oriented photos whose orientation has no standard errors: where one of them takes part no covariance is told. */
  without_errors: string[];
  /** Every oriented photo. */
  photos: PhotoPrediction[];
}

/** Where a point should be in one photo, pixels; its own measurement there takes no part in it. */
export interface PhotoPrediction {
  photo: string;
  measured: [number, number] | null;
  place: [number, number] | null;
  /** uu, uv, vv of the place; null without the standard errors of the photos' orientations. */
  covariance: [number, number, number] | null;
  /** The part of it that is known: it is at least as much. */
  least_covariance: [number, number, number] | null;
  /** Whether the place lies in the picture. */
  inside: boolean;
  /** Distance of the measurement from the place, in pixels and in standard errors of both. */
  off_px: number | null;
  off_sigmas: number | null;
  /** Where the ray of each other photo runs: corners in order. */
  lines: { from: string; course: [number, number][] }[];
}

/** Something to say about an orientation: an assumption, or what could not be found and why. */
export type Note =
  | { note: "principal_distance"; camera: string; value: number; source: "known_points" | "assumed" }
  /** The network determines the principal distance badly; sigma is null where it does not at all. */
  | { note: "principal_distance_weak"; camera: string; value: number; sigma: number | null }
  | { note: "principal_distance_changed"; camera: string; value: number; given: number }
  /** Photos that share too little to be joined; the first group, the largest, is oriented. */
  | { note: "groups"; groups: string[][] }
  /** Two orientations fit the photo's known points alike: the one not taken; rms of the one taken and the other. */
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
      /** As many rays meet in one place as in another: the photos of each. */
      | { why: "undecided"; first: string[]; second: string[] }
    ))
  | { note: "measurement_disagrees"; photo: string; point: string; distance_px: number | null }
  /** Given minus where the photos see the point, oriented by the other control points; its size in standard errors of both. */
  | { note: "control_misfit"; point: string; difference: [number, number, number]; sigma_ratio: number }
  /** Two control points whose coordinates fit when they are exchanged. */
  | { note: "exchanged_points"; points: [string, string] }
  /** Points nearer to each other than their standard errors tell apart. */
  | { note: "double_points"; pairs: [string, string][] }
  | ({ note: "mirrored_control" } & MirroredControl)
  | ({ note: "undecided_axes" } & UndecidedAxes)
  | ({ note: "unit_ratio" } & UnitRatio)
  /** Without control points and all photos: nothing is oriented. */
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

/** A photo of a network: either its rotation (omega, phi, kappa in radians) or the point it is aimed at with a roll. */
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
  /** Direction the target faces; null: seen from everywhere, and not rendered. */
  normal?: [number, number, number] | null;
  diameter?: number | null;
  ring?: { sectors: number; code: number } | null;
  grey?: number | null;
  patch?: { ratio: number; grey: number } | null;
}

/** A parallelogram that fills the view and hides what lies behind it. */
export interface Face {
  corner: [number, number, number];
  along: [number, number, number];
  across: [number, number, number];
  grey?: number;
  texture?: number;
  grain?: number;
}

/** A network on paper, from which a project is simulated. */
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
  /** Largest angle between the ray and the direction a target faces, radians. */
  max_incidence?: number;
  /** Points nearer than this to the picture's border are not measured, pixels. */
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

/** What is printed on sheets of targets. Lengths in mm; places on a sheet from its top left corner, x right, y down. */
export interface SheetOptions {
  /** Stands at the top of every sheet. */
  title?: string;
  /** Language of what is written on the sheets ["en"]. */
  language?: "en" | "ko";
  /** ["a4"] */
  paper?: "a4" | "a3" | "letter";
  /** ["ring-14"] */
  family?: CodeFamily;
  /** Numbers of the codes, as "1-20, 35"; empty: the first `codes` of those with the largest mutual distance. */
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
  /** Distance of the ends of a pair; one that the paper has room for is printed [1000]. */
  bar_length?: number;
  /** A plate with codes and dots over sheets edge to edge. */
  field?: { columns: number; rows: number } | null;
  cut_marks?: boolean;
  labels?: boolean;
  /** What the ruler of 100 mm across measures on the print. */
  measured?: number | null;
  /** What the one down measures; null: as the one across. */
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
  /** "sheets.pdf", "targets.csv", and as far as there are any "distances.csv" and "control.csv". */
  files: Record<string, Uint8Array>;
  targets: PrintedTarget[];
  /** Scale bars; sigma is null where the ends are mounted by hand. */
  bars: { from: string; to: string; length: number; sigma: number | null }[];
  /** Smallest mutual distance of the codes; null with fewer than two. */
  least_distance: number | null;
  /** Scale of the print across and down, 1 until a ruler is measured. */
  scale: [number, number];
  scale_sigma: number;
  /** Diameter of the dots on paper. */
  diameter: number;
}

/** How many codes of a family differ by at least so many sectors in every rotation. */
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
  /** A pixel on the object. */
  pixel: number;
  /** Diameter of 8 px at each angle. */
  least: number[];
  /** Diameter of 15 px at each angle. */
  best: number[];
  /** Smaller axis of the dots at each angle, pixels. */
  pixels: number[];
}

/** A photo to take: its rotation, or the point it is aimed at with a roll. */
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

/** What will be photographed, from where, and how accurate it has to become. Lengths in the project's unit, angles in radians. */
export interface Plan {
  cameras?: Camera[];
  /** What is sharp; without f-number, focus or pixel pitch everything is. */
  lens?: { f_number?: number | null; focus?: number | null; circle_px?: number; unit_mm?: number };
  form?: PlanForm | null;
  points?: Point[];
  faces?: PlanFace[];
  distances?: { from: string; to: string; sigma: number }[];
  datum?: Datum;
  stations?: PlanStation[];
  variants?: { name?: string; stations?: PlanStation[] }[];
  /** Boxes in which nobody can stand. */
  forbidden?: { low: [number, number, number]; high: [number, number, number] }[];
  /** Standard error of an image coordinate, pixels [0.05]. */
  sigma?: number;
  /** [60°] */
  max_incidence?: number;
  /** Pixels [10]. */
  margin?: number;
  /** Smallest axis of a target's image, pixels [8]. */
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
  /** Median distance to what it sees. */
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
}

/** What a plan promises; standard errors are 1σ. */
export interface PlanPrediction {
  stations: PredictedStation[];
  points: PredictedPoint[];
  cameras: AdjustedCamera[];
  worst: string | null;
  largest: number | null;
  rms: number | null;
  /** From standard errors to the wanted probability. */
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
}

export interface SuggestedPhoto {
  station: PlanStation;
  /** The criterion with it; null where it leaves points undetermined. */
  value: number | null;
  sees: number;
  compared: number;
}

export interface MakePlanOptions {
  /** Most photos [40]. */
  most?: number;
}

export interface MadePlan {
  stations: PlanStation[];
  prediction: PlanPrediction;
  compared: number;
  /** Why the search ended; what the plan lacks then is in `prediction.lacks`. */
  ended:
    | { why: "reached" | "no_place" | "time" }
    | { why: "most_photos"; most: number }
    /** So many further photos gained nothing. */
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

/** What a list of points does not say itself, or what is to be taken in place of what it says. */
export interface ListChoices {
  /** Decimal sign; null: from the rows. With "point", commas are thousands separators. */
  decimal?: "point" | "comma" | null;
  /** Order of the horizontal coordinates of a list without heading; null: X (east) before Y (north). */
  axes?: "xy" | "yx" | null;
  /** Unit of the coordinates of a list whose heading has none. */
  unit?: Unit | null;
  /** What each column holds, null: it is left alone; in place of what heading and content say. */
  columns?: (ControlField | null)[] | null;
  /** Encoding of bytes; null: from what is in them. Of no matter for a string. */
  encoding?: TextEncodingName | null;
  /** What separates the fields; null: from the rows. */
  separator?: "comma" | "semicolon" | "tab" | "blanks" | null;
  /** Line of the first row of points, counted from 1; the row before it is the heading. */
  first_line?: number | null;
  /** Unit of columns of standard errors whose heading has none; null: that of the coordinates. */
  sigma_unit?: Unit | null;
  /** One standard error for all points that have none of their own. */
  sigma?: SigmaRule | null;
}

/** Choices of reading. */
export interface ImportChoices extends ListChoices {
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

/** Something that has no place in the document or in the file, by its name there. */
export interface Ignored {
  name: string;
  count: number;
}

/** What a format leaves open and was taken for granted. */
export type Assumed =
  | "sigma_one_pixel"
  | "image_size_from_principal_point"
  | "image_size_from_measurements"
  | "four_coefficients_radial_tangential"
  | "unit_unknown"
  | "system_of_chunk";

export type CameraFormat = "opencv" | "ros" | "kalibr" | "mrcal" | "colmap" | "agisoft-lens" | "micmac";
export type CameraImportFormat = "auto" | CameraFormat | "metashape" | "meshroom";
export type CameraExportFormat = CameraFormat;

export interface CameraImportOptions {
  /** Part of the picture over which a model is converted, a polygon of pixels; null: the file's own, else all of it. */
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
  /** Part of the picture in which the file says it is valid. */
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
export type ControlField = "id" | "label" | "X" | "Y" | "Z" | "sX" | "sY" | "sZ" | "sXY" | "sigma" | "role" | "diameter";
export type TextEncodingName = "utf-8" | "utf-16" | "cp949" | "windows-1252";
export type ListFormat = "table" | "leica_gsi" | "sokkia_sdr" | "job_xml" | "land_xml" | "odm_gcp";
/** What an assumption rests on; "undecided": nothing decides, it has to be asked. */
export type Basis = "heading" | "content" | "given" | "convention" | "undecided";

/** How a list of points was read. */
export type Assumption =
  | { kind: "format"; format: ListFormat; by: Basis }
  /** `by: "convention"`: it is none of the others. */
  | { kind: "encoding"; encoding: TextEncodingName; by: Basis }
  /** The first row of points, where lines before it are passed over. */
  | { kind: "first_row"; line: number; by: Basis }
  /** What the list has beside its points and is not kept. */
  | { kind: "beside"; what: "lines_before" | "measurements" | "image_measurements" | "deleted" | "references" | "geographic"; count: number }
  /** Names that were made up, since the list has none: "GCP 1" and so on. */
  | { kind: "names_made"; count: number }
  /** One standard error for so many points without one of their own; undecided: the unit of the coordinates has to be known first. */
  | { kind: "common_sigma"; rule: SigmaRule; points: number; by: Basis }
  | { kind: "separator"; separator: "comma" | "semicolon" | "tab" | "blanks"; by: Basis }
  | { kind: "decimal_sign"; sign: "point" | "comma"; by: Basis; example?: string }
  | { kind: "columns"; columns: (ControlField | null)[]; by: Basis }
  | { kind: "axis_order"; order: "xy" | "yx"; by: Basis }
  | { kind: "sigma_columns"; columns: number[]; by: Basis }
  | { kind: "unit"; unit: Unit | null; by: Basis }
  /** Columns whose headings are not understood and which are left alone. */
  | { kind: "ignored"; columns: string[] }
  /** Headings with something in round brackets that is neither an axis nor a unit. */
  | { kind: "remarks"; headings: string[] };

/** A project that was read, with what was taken for granted. */
export interface Imported extends Project {
  /** File by file, for `control-csv`. */
  assumptions?: { file: string; assumptions: Assumption[] }[];
  /** The format, for networks of other programs. */
  recognised?: Exclude<ImportFormat, "auto">;
  /** Cameras whose model was converted. */
  conversions?: Conversion[];
  assumed?: Assumed[];
  /** What of the files is not kept. */
  ignored?: Ignored[];
}

export type ImportFormat = "sightline" | "package" | "control-csv" | "mark-points" | "photomodeler" | "aicon" | "dbat" | "comparator" | "auto" | "colmap" | "metashape" | "bal" | "bundler" | "meshroom" | "vstars";
export type ExportFormat = "sightline" | "package" | "control-csv" | "mark-points" | "report" | "plots" | "csv" | "tsv" | "spreadsheet" | "spreadsheet-cp949" | "calibration" | "dxf" | "dxf-2010" | "landxml" | "ply" | "gltf" | "colmap" | "colmap-binary" | "metashape" | "bal" | "bundler" | "meshroom" | "vstars" | "opencv";

/** A parameter of a fit. */
export interface Coefficient {
  name: string;
  value: number;
  /** Null without redundancy. */
  sigma: number | null;
}

/** Plates carried onto their fiducial marks. */
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

/** What every function throws. */
export interface SightlineError extends Error {
  /** Stable name of the kind of error. */
  code: string;
  where: { file?: string; photo?: string; point?: string; camera?: string; line?: number; field?: string };
  /**
   * The values that the sentence is made of. Errors that have a reason (`invalid`, `broken_image`, `cannot_orient`) name it with its
   * values in `reason` and tell it in `detail`.
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

/** What `readList` gives. */
export interface PointList {
  /** The points that were understood, with their lines. */
  points: (Point & { line: number; label?: string })[];
  /** Lines that were not, each with the reason as a sentence and as data. */
  rejected: { line: number; text: string; message: string; error: unknown }[];
  /** Null: it has to be asked. */
  unit: Unit | null;
  assumptions: Assumption[];
  /** Those of the assumptions that nothing decides: ask before the points are used, and read again with the answer. */
  undecided: Assumption[];
  /** Words of the heading, column by column; empty without one. */
  heading: string[];
  /** Fields of the first rows as the text has them. */
  sample: string[][];
}

/** What `readCoordinates` gives. */
export interface CoordinateList {
  points: ListedPoint[];
  /** Where the heading or the caller names one. */
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
   * Control points of a project: `released` (default) adjusts it as a free network, since given coordinates are the same in every epoch; `kept`
   * says that they were measured anew for this epoch.
   */
  control?: "released" | "kept";
  points?: (Omit<ListedPoint, "id"> & { id: string | number })[] | null;
  covariance?: (Omit<ListedCovariance, "points"> & { points: (string | number)[] }) | null;
  /** Standard deviation of unit weight behind a list. */
  sigma0?: number | null;
  /** Its redundancy; null: the standard errors count as certain. */
  redundancy?: number | null;
  /** Unit of a list; null: that of the other epochs. */
  unit?: string | null;
  /** Whether a list has a scale of its own; null: it has. */
  scale?: boolean | null;
}

/** Movement of a group: translation and rotation; scale too; homogeneous strain too. */
export type GroupModel = "rigid" | "similarity" | "affine";

/** Lengths of displacement from which a state is reported. */
export interface MonitoringLimits {
  warning: number;
  alarm: number;
}

/** Which motion of the camera is taken out of an uncertainty or a difference. */
export type MotionReference = "rotation" | "rotation_translation" | "photos" | "none";

/** What `projectionUncertainty` takes. */
export interface UncertaintyOptions {
  /** May be left out where the adjustment has one camera. */
  camera?: string | null;
  /** Of a camera with an interior orientation per photo. */
  photo?: string | null;
  /** Places along width and height, borders included; [25, 17] unless given. */
  grid?: [number, number];
  /** Of the points, in the project's unit; null: directions. */
  distance?: number | null;
  /** Where the motion is fitted: a disc in the middle of the image, or all of it. */
  region?: "centre" | "all";
  /** `photos`: the mean motion of the photos against the object, which needs no fit (mrcal's mean-pcam). */
  reference?: MotionReference;
}

/** What `projectionUncertainty` gives. Maps are rows of `v` of columns `u`; null where the model gives no ray. */
export interface ProjectionUncertainty {
  camera: string;
  photo?: string;
  /** Whose uncertainty it is; what was held counts as known. */
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

/** What `compareCameras` takes. */
export interface DifferenceOptions {
  grid?: [number, number];
  distance?: number | null;
  region?: "centre" | "all";
  reference?: Exclude<MotionReference, "photos">;
}

/** What `compareCameras` gives: where the second camera sees what the first sees, minus where the first does, pixels. */
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

/** What `crossValidate` takes. `reference` is not `photos`. */
export interface CrossOptions extends DifferenceOptions {
  /** In how many parts the photos are split, balanced by position and roll: 2, at most 8. */
  parts?: number;
  /** May be left out where the project has one camera. */
  camera?: string | null;
  /** How each part is adjusted; not with `snooping`, `robust` or `variance_components`, which take a wrong model for noise. */
  adjust?: AdjustOptions;
}

/** A part of the photos, calibrated by itself. */
export interface CrossPart {
  photos: string[];
  sigma0: number | null;
  /** What its residuals significantly depend on (p < 0.001). */
  patterns: PatternKind[];
  camera: AdjustedCamera;
}

/** What `crossValidate` gives. Maps are rows of `v` of columns `u`; null where a part gives no ray. */
export interface CrossValidation {
  camera: string;
  parts: CrossPart[];
  u: number[];
  v: number[];
  /** Standard error of the difference of two parts by the a priori standard errors (not scaled with sigma0, which a wrong model makes large), pixels: the root of the sum of both covariances in the worst direction. */
  predicted: (number | null)[][];
  /** Length of the difference after the best rotation, pixels. */
  observed: (number | null)[][];
  /** Observed over predicted; of several pairs of parts the largest. */
  ratio_map: (number | null)[][];
  /** Whether every part has a measurement within one step of the grid. Only there the parts are judged. */
  covered: boolean[][];
  /** The covered place with the largest ratio; `sigma` is what was predicted there. */
  worst: { u: number; v: number; sigma: number } | null;
  ratio: number | null;
  /** The largest ratio to standard errors that include sigma0. */
  ratio_with_sigma0: number | null;
  /** The ratio that a right model exceeds anywhere once in a thousand, by draws from the covariances, at least 2; 2 where the residuals of every part have a pattern. */
  limit: number;
  /** `larger_noise`: beyond the limit, but not with sigma0, and no part has a pattern: the a priori standard errors are too small. */
  verdict: "agrees" | "larger_noise" | "wrong_model";
}

/** Name of a camera model. */
export type CameraModelName = "brown" | "opencv" | "opencv_rational" | "opencv_fisheye";

/** What a camera in another model has left. */
export interface ModelConversion {
  camera: string;
  from: CameraModelName;
  to: CameraModelName;
  /** Largest difference of the pixels of one direction over the picture; null while the principal distance is not known. */
  max_px: number | null;
  rms_px: number | null;
  /** Share of the picture that it holds for: a perspective model has no image of rays far off the axis (75 degrees). */
  share: number;
  /** Parameters with an a priori standard error that the other model cannot use: those that it has are estimated without it. */
  dropped: Parameter[];
}

/** What `convertCamera` gives: the camera, the interior orientations of its photos and its colours in the other model. */
export interface ConvertedCamera {
  project: Project;
  conversion: ModelConversion;
}

/** What `compareModels` takes. */
export interface ModelsOptions {
  /** May be left out where the project has one camera. */
  camera?: string | null;
  /** Of the choice of image points that are held out: 1. */
  seed?: number;
  /** How each model is adjusted; not with `snooping`, `robust` or `variance_components`, by which every model would choose its own observations. */
  adjust?: AdjustOptions;
}

/** A camera model on the network; `compareModels` gives one each. */
export interface ComparedModel {
  model: CameraModelName;
  /** What its start values left of the present camera; null where it could not be converted. */
  conversion: ModelConversion | null;
  /** With its adjusted values, and what is estimated of it; null where it failed. */
  camera: Camera | null;
  sigma0: number | null;
  /** Estimated. */
  parameters: Parameter[];
  /** Parameters of distortion that are not told from 0. */
  insignificant: Parameter[];
  /** Of coordinates of a fifth of the image points, predicted without them, pixels; null where none could be held out. */
  held_out_rms: number | null;
  /** Schwarz's criterion less that of the best. */
  bic: number | null;
  /** `too_stiff`: it cannot follow the lens; `overfits`: no better than the best, with more parameters. */
  verdict: "best" | "as_good_with_fewer" | "as_good" | "too_stiff" | "overfits" | "failed";
  /** Why it failed: an error as in `data` of one that is thrown. */
  failure: Record<string, unknown> | null;
}

/** What `compareEpochs` takes. */
export interface CompareOptions {
  /** Two or more, in time. */
  epochs: Epoch[];
  /** Null: the control points, else the datum points of the projects, else all common points that are not numbered automatically. */
  reference?: (string | number)[] | null;
  ignored?: (string | number)[];
  /** `joint`: the stable reference points of a pair get one set of coordinates, cameras are one per epoch. */
  method?: "coordinates" | "joint";
  /** 0.05. */
  significance?: number;
  /** Correction for the number of object points. */
  correction?: "holm" | "bonferroni" | "none";
  /** Probability with which a detectable displacement is found: 0.80. */
  power?: number;
  /** `estimated`: pooled where the variance factors are equal; `separate`: one each; `given`: σ0 = 1 with infinitely many degrees of freedom. */
  variance?: "estimated" | "separate" | "given";
  /** `given`: the epochs are in one system and nothing is transformed. */
  datum?: "reference" | "given";
  groups?: { name: string; points: (string | number)[]; model?: GroupModel }[];
  thresholds?: (MonitoringLimits & { points?: Record<string, MonitoringLimits>; groups?: Record<string, MonitoringLimits> }) | null;
  /** Names of one of these prefixes and digits are numbers that a program gave, matched by position: ["u", "TARGET"]. */
  automatic?: string[];
}

/** A test: passed where the statistic does not exceed the limit. */
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
  /** Name in the later epoch, where it was matched by position under another one. */
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
  /** Smallest detectable displacement along X, Y, Z and along the least favourable direction. */
  detectable: { axes: [number | null, number | null, number | null]; worst: number } | null;
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
  /** Whether it moved as its model says. */
  fit: MonitoringTest | null;
  residuals: { id: string; difference: [number, number, number]; sigma: [number, number, number] }[];
  /** Null without thresholds. */
  state: "quiet" | "warning" | "alarm" | null;
  error?: { code: "too_few_points"; needed: number; given: number } | { code: "undetermined" } | { code: "no_stable_group" };
}

/** Why a point took no part in a pair. */
export type LeftOutOfPair =
  | { code: "only_in" | "no_sigma" | "no_counterpart" | "no_identity"; epoch: string }
  | { code: "ambiguous"; epoch: string; candidates: string[] }
  | { code: "ignored" | "held" };

/** What a reader of a pair must know. */
export type PairNote =
  | { code: "variances_differ" | "scale_differs" | "no_stable_group" }
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
  /** Lengths of the later epoch over those of the earlier one; null where one has no scale. */
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

/** What `compareEpochs` gives. */
export interface Monitoring {
  method: "coordinates" | "joint";
  unit: string | null;
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
  /** Reference points stable in all pairs with the first epoch; empty where fewer than four are. */
  series_datum: string[];
}

/** What may be varied; what is left out has the paper's value. */
export interface ExperimentOptions {
  /** Seed of all noise. */
  seed?: number;
  /** Standard deviation of image coordinates, µm (kang, film, lee-structure). */
  image_sigma_um?: number | null;
  /** Standard deviation of the pixels' noise, share of full scale (lee-calibration, kim, sensor). */
  pixel_noise?: number | null;
  /** Standard error of control coordinates, mm (kang, lee-structure, kim). */
  control_sigma_mm?: number | null;
  /** Rounds of Monte Carlo (kang). */
  rounds?: number | null;
  /** Network of the project to open: "1.4-5A", "H'" (kang), "I-free" (lee-structure). */
  network?: string | null;
  /** Photos left out of the second run (lee-calibration). */
  left_out?: string[] | null;
  /** How centres are measured for the adjustment (lee-calibration). */
  method?: "least_squares" | "ellipse" | "intensity" | "gradient" | null;
  /** Told how far the experiment is; stops it by returning false. */
  on_progress?: (done: number, of: number) => void | boolean;
}

/** Something to draw: a point with its role, or a photo with its viewing direction. */
export interface Drawn {
  id: string;
  xyz: [number, number, number];
  direction?: [number, number, number];
  role?: "tie" | "control" | "check";
}

/** An axis of a chart; ticks name places along it, groups in a second row. */
export interface Axis {
  id: string;
  unit: string;
  ticks: { at: number; text: string; group: boolean }[];
}

/** Result of an experiment. Cells are numbers, names or null; `paper` marks what the paper prints. */
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
  /** What the paper does not say, or says otherwise, and was therefore chosen here. */
  assumptions: { id: string; unit: string; ours: number | null; paper: number | null }[];
  /** Ready to be opened and adjusted. */
  project: Project;
}
