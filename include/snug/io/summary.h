#ifndef snug_io_summary_h
#define snug_io_summary_h

#include <snug/advice/advice.h>
#include <snug/base/run_context.h>
#include <snug/mesh/tearing.h>
#include <snug/optimization/minimize.h>
#include <snug/state/contact_state.h>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug::io {
/**
 * The numbers of a run, as summary.json holds them. Other tools read that
 * file: the members down to `times` stand in it under their own names, in
 * their order, whatever the task was; what was not computed is null, like
 * every number that is not finite. Keys may be added, never renamed.
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
    unsigned int  bodies     = 0;
    unsigned long cells      = 0; ///< active, of all ranks
    unsigned long dofs       = 0; ///< of the untorn bodies, none hanging
    unsigned int  subdomains = 0;
    unsigned int  ranks      = 1;
    unsigned long dual_rows = 0, contact_rows = 0, kernel_dimension = 0;
  };

  /// Members as in state::PairState.
  struct Pair
  {
    std::string         name;
    unsigned int        rows = 0, active_contacts = 0;
    std::vector<double> force, moment, centre;
    double              contact_area = none, max_pressure = none;
    std::vector<double> peak;
    double              peak_size = none;
  };

  /// Members as in state::Reaction.
  struct Reaction
  {
    std::string         name;
    std::vector<double> centre, force, moment;
  };

  /// Members as in accuracy::EnergyEstimate, and the estimated errors of responses by name.
  struct Accuracy
  {
    double                                      error = none, relative = none;
    std::vector<std::pair<std::string, double>> responses;
  };

  /// Members as in state::ContactState; linear_f_mults 0 becomes null.
  struct State
  {
    double                least_scaled_jacobian = none;
    double                energy = none, compliance = none;
    double                strain_energy = none;
    std::vector<double>   contact_force;
    double                contact_area = none, max_pressure = none;
    unsigned int          active_contacts = 0, weak_contacts = 0;
    double                degeneracy_distance = none;
    unsigned int          outer_iterations    = 0;
    unsigned long         f_mults = 0, linear_f_mults = 0;
    std::string           method; ///< the solver that finished
    std::vector<Pair>     pairs;
    std::vector<Reaction> reactions;
    std::vector<double>   load, balance;
    /// names and values of the scene's responses
    std::vector<std::pair<std::string, double>> responses;
    state::Certificate                          certificate;
    double                                      tolerance = none; ///< met by the certificate
    state::Assumptions                          assumptions;
    std::optional<Accuracy>                     accuracy;
  };

  /// One way to compute the gradient, with what it cost.
  struct GradientRow
  {
    std::string         method;
    unsigned long       f_mults                = 0;
    unsigned long       numeric_factorizations = 0;
    double              seconds                = none;
    std::vector<double> values;      ///< [objective / length]
    double              step = none; ///< relative, of differences
    /// ||u' - u'_direct|| / ||u'_direct|| over all nodes and variables
    double displacement_difference = none;
    bool   differentiable          = true; ///< or one-sided only
  };

  struct Gradient : GradientRow
  {
    std::string reason; ///< why 'auto' took the method
    /// All methods side by side, where the task compares them.
    std::vector<GradientRow> methods;
  };

  /// The objective of the first and the last design, each with its estimated error.
  struct Gain
  {
    double initial = none, initial_error = none, final = none, final_error = none;
    bool   counts = false; ///< it is larger than the error at the last design
  };

  struct Optimization : optimization::OptimizationResult
  {
    std::string         algorithm;
    std::optional<Gain> gain = {}; ///< if errors of the objective are estimated
    /// of the design found with contact paired anew there, if that is
    /// another pairing
    double objective_paired_anew = none, constraint_violation_paired_anew = none;
  };

  /// One of several load cases.
  struct LoadCase
  {
    std::string          name;
    double               weight = 1.;
    State                state; ///< of the final design
    std::optional<State> initial_state;
  };

  /// A response of a load case on one of several meshes.
  struct MeasuredResponse
  {
    std::string name; ///< with its load case, if there are several
    double      value = none, error = none;
  };

  /// One of the meshes on the way to a target.
  struct AdaptedMesh
  {
    unsigned long                 dofs          = 0;
    double                        contact_faces = none; ///< across; none where closed all over
    double                        tolerance     = none;
    unsigned long                 f_mults       = 0;
    double                        seconds       = none;
    std::vector<MeasuredResponse> responses;
  };

  struct Adaptation
  {
    bool                     met = false; ///< all targets
    std::vector<AdaptedMesh> meshes;
    /// of the mesh with all cells refined, if that is solved
    std::vector<MeasuredResponse> verified;
  };

  struct Times
  {
    double setup = 0., assembly = 0., factorization = 0., soft_modes = 0., solve = 0.,
           gradient = 0., accuracy = 0., output = 0., total = 0.; ///< [s]
  };

  /// Of the largest rank and of all together, when it was most [MB].
  struct Memory
  {
    double largest = 0., total = 0.;
    /// At the end of each stage that ran, and at the start, without what ranks share; the largest
    /// rank's.
    std::vector<std::pair<std::string, double>> stages;
  };

  Program program;
  Mesh    mesh;
  /// Of the final design. Of several load cases this is the first one; in the file it also has
  /// the main values of all load cases by name, and the largest value of each with its load case.
  State                       state;
  std::optional<Gradient>     gradient;
  std::optional<Optimization> optimization;
  Work                        work;
  Times                       times;
  Memory                      memory;
  std::string                 task;
  std::optional<State>        initial_state; ///< of the first design
  std::vector<LoadCase>       load_cases;    ///< empty if there is only one
  std::vector<std::string>    warnings;
  std::optional<Adaptation>   accuracy; ///< to a target

  /// If it was asked for.
  std::optional<std::vector<advice::Advice>> advice;

  /// The JSON text; doubles read back as the same numbers.
  std::string json() const;

  /// Write json() to the file @p path. For one rank.
  /// @throws std::runtime_error if it cannot be written.
  void write(const std::string &path) const;
};

/// Versions of the program and its packages, and the BLAS in use.
Summary::Program program_info(const RunContext &context);

/**
 * Name of a BLAS from the file its dgemm was loaded from and, for OpenBLAS,
 * its own description (else empty); "reference" for the reference BLAS.
 */
std::string blas_name(const std::string &file, const std::string &openblas_config);

/// One line of advice if the BLAS is the reference one; else empty.
std::string blas_warning(const Summary::Program &program);

/// All of Mesh but dual_rows, contact_rows and kernel_dimension.
template <int dim>
Summary::Mesh summarize(const mesh::BodyMesh<dim> &mesh, const mesh::Tearing &tearing);

template <int dim>
Summary::State summarize(const state::ContactState<dim> &state);

/// What the ranks have taken so far. Collective.
Summary::Memory collect_memory(const RunContext &context);

/// Seconds of the stages named as the members of Times, of the slowest
/// rank. Collective.
Summary::Times collect_times(const RunContext &context);
} // namespace snug::io

#endif
