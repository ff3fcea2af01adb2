#ifndef snug_io_summary_h
#define snug_io_summary_h

#include <snug/advice/advice.h>
#include <snug/base/run_context.h>
#include <snug/io/balance.h>
#include <snug/mesh/tearing.h>
#include <snug/optimization/minimize.h>
#include <snug/state/contact_state.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug::scene {
struct Scene;
} // namespace snug::scene

namespace snug::io {
/**
 * The numbers of a run, as written to summary.json. Other tools read that file. The members down
 * to `times` are written under their own names, in their order, for every task. Values that were
 * not computed are null, like every number that is not finite. Keys may be added, but are never
 * renamed.
 */
struct Summary
{
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  struct Program
  {
    std::string  version, dealii, petsc, blas, compiler;
    unsigned int ranks = 1;
  };

  struct Mesh
  {
    unsigned int  bodies      = 0;
    unsigned long cells       = 0; ///< active cells of all ranks
    unsigned long dofs        = 0; ///< unknowns of the untorn bodies, without hanging nodes
    unsigned int  subdomains  = 0;
    unsigned int  clusters    = 0; ///< of subdomains; as many as subdomains if they are not joined
    unsigned int  ranks       = 1;
    unsigned long constraints = 0, contact_rows = 0, rigid_body_modes = 0;
  };

  /// Members are those of accuracy::EnergyEstimate, and the estimated errors of responses by name.
  struct Accuracy
  {
    double                                      error = none, relative = none;
    std::vector<std::pair<std::string, double>> responses;
  };

  /// Part of a state, made by summarize().
  using State = nlohmann::ordered_json;

  /// A method to compute the gradient, with its cost.
  struct GradientRow
  {
    std::string         method;
    unsigned long       f_mults                = 0;
    unsigned long       numeric_factorizations = 0;
    double              seconds                = none;
    std::vector<double> values;      ///< [objective / length]
    double              step = none; ///< relative step of the differences
    /// ||u' - u'_direct|| / ||u'_direct|| over all nodes and variables
    double displacement_difference = none;
    bool   differentiable          = true; ///< false if there are only one-sided derivatives
  };

  struct Gradient : GradientRow
  {
    std::string reason; ///< reason if 'auto' chose the method
    /// all methods, if the task compares them
    std::vector<GradientRow> methods;
  };

  /// Objective of the first and the last design, each with its estimated error.
  struct Gain
  {
    double initial = none, initial_error = none, final = none, final_error = none;
    /// whether the gain is larger than the error at the last design
    bool counts = false;
  };

  /// A constraint in the first and in the last design.
  struct Constraint
  {
    std::string name; ///< as in the scene
    double      initial, value, limit;
    std::string relation;  ///< <=, = or >=
    double      violation; ///< relative to the limit
    bool        active;
  };

  struct Optimization : optimization::OptimizationResult
  {
    std::string         algorithm;
    std::optional<Gain> gain = {}; ///< present if errors of the objective are estimated
    /// values of the final design after a new contact search, if the contact is paired differently
    double objective_after_contact_update = none, constraint_violation_after_contact_update = none;
    std::vector<Constraint> constraints = {};
    /// variables of the design by the name of their shape
    std::vector<std::pair<std::string, std::vector<double>>> shapes = {};
  };

  /// A load case of a run with several load cases.
  struct LoadCase
  {
    std::string          name;
    double               weight = 1.;
    State                state; ///< state of the final design
    std::optional<State> initial_state;
  };

  /// A response of a load case on one of several meshes.
  struct MeasuredResponse
  {
    std::string name; ///< with its load case, if there are several
    double      value = none, error = none;
  };

  /// A face of profile.step.
  struct ProfileFace
  {
    std::string               name;
    std::vector<unsigned int> spans;          ///< of B-splines, per direction
    std::string               kind      = {}; ///< "curve", "revolved curve" or "surface"
    double                    deviation = none, asked = none; ///< maximum [length]
  };

  /// One of the meshes refined for a target.
  struct AdaptedMesh
  {
    unsigned long dofs          = 0;
    double        contact_faces = none; ///< across a contact; none if the whole side is closed
    double        tolerance     = none;
    unsigned long f_mults       = 0;
    double        seconds       = none;
    std::vector<MeasuredResponse> responses;
  };

  struct Adaptation
  {
    bool                     met = false; ///< whether all targets are met
    std::vector<AdaptedMesh> meshes;
    /// responses on the mesh with all cells refined, if that mesh is solved
    std::vector<MeasuredResponse> verified;
  };

  struct Times
  {
    double setup = 0., assembly = 0., factorization = 0., soft_modes = 0., solve = 0.,
           gradient = 0., accuracy = 0., output = 0., total = 0.; ///< [s]
  };

  /// Memory of the largest rank and of all ranks together, at its maximum [MB].
  struct Memory
  {
    double largest = 0., total = 0.;
    /// Memory at the end of each stage that ran, and at the start, without memory shared by
    /// ranks, of the largest rank.
    std::vector<std::pair<std::string, double>> stages;
  };

  Program program;
  Mesh    mesh;
  /// State of the final design. If there are several load cases, this is the first one. In the
  /// file it also contains the main values of all load cases by name, and the maximum of each
  /// value with its load case.
  State                       state;
  std::optional<Gradient>     gradient;
  std::optional<Optimization> optimization;
  Work                        work;
  Times                       times;
  Memory                      memory;
  std::string                 task;
  std::optional<State>        initial_state; ///< state of the first design
  std::vector<LoadCase>       load_cases;    ///< empty if there is only one load case
  std::vector<Warning>        warnings;
  /// {quantity, unit} for "length", "force", "stress" and the responses; empty without 'Units'
  std::vector<std::pair<std::string, std::string>> units;
  std::optional<Adaptation>                        accuracy; ///< adaptation to a target
  std::vector<ProfileFace>                         profile;  ///< faces of profile.step
  std::optional<Balance>                           balance;  ///< of several ranks

  /// advice, if the user asked for it
  std::optional<std::vector<advice::Advice>> advice;

  /// Return the JSON text. Doubles are read back as the same numbers.
  std::string json() const;

  /// Return the content of load_cases.csv: a line per load case, and for optimizations per design.
  std::string load_case_table() const;

  /// Write json() to the file @p path. For one rank.
  /// @throws std::runtime_error if the file cannot be written.
  void write(const std::string &path) const;
};

/// Return the versions of the program and its packages, and the BLAS in use.
Summary::Program program_info(const RunContext &context);

/**
 * Return the name of a BLAS, from the file from which its dgemm was loaded and, for OpenBLAS, its
 * own description (else empty). The name is "reference" for the reference BLAS.
 */
std::string blas_name(const std::string &file, const std::string &openblas_config);

/// Return one line of advice if the BLAS is the reference BLAS; else empty.
std::string blas_warning(const Summary::Program &program);

/// Return the member units.
std::vector<std::pair<std::string, std::string>> summarize_units(const scene::Scene &scene);

/// Return all members of Mesh except clusters, constraints, contact_rows and rigid_body_modes.
template <int dim>
Summary::Mesh summarize(const mesh::BodyMesh<dim> &mesh, const mesh::Tearing &tearing);

/**
 * Return the part of a state. Its keys have the names of the members of state::ContactState, which
 * gives formulas and units.
 * @param[in] responses names and values of the scene's responses.
 * @param[in] accuracy estimated errors, if there are any.
 */
template <int dim>
Summary::State summarize(const state::ContactState<dim>                    &state,
                         const std::vector<std::pair<std::string, double>> &responses = {},
                         const std::optional<Summary::Accuracy>            &accuracy  = {});

/// Return the memory of all ranks up to the call. Collective.
Summary::Memory collect_memory(const RunContext &context);

/// Return the seconds of the stages named like the members of Times, of the slowest rank.
/// Collective.
Summary::Times collect_times(const RunContext &context);
} // namespace snug::io

#endif
