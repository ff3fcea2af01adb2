#ifndef snug_state_contact_state_h
#define snug_state_contact_state_h

#include <snug/feti/subdomain_system.h>
#include <snug/mesh/body_mesh.h>
#include <snug/qp/solver.h>

#include <limits>
#include <vector>

namespace snug::state {
/**
 * Errors of a solution, recomputed from K, f, B and g, all relative:
 * equilibrium ||K u - f + B' lambda|| / (||f|| + ||B' lambda||), the worst
 * body; continuity max|B_E u - g_E| and penetration max(B_I u - g_I)+
 * over max_i(F_ii |lambda_i|, |f_i| / K_ii); negative pressure max(-lambda_I)+ over
 * max lambda_I; complementarity |lambda' w| over the strain energy.
 */
struct Certificate
{
  double equilibrium       = 0.;
  double continuity        = 0.;
  double penetration       = 0.;
  double negative_pressure = 0.;
  double complementarity   = 0.;

  double worst() const;
};

/// One contact row of a state; physical units.
struct ContactPoint
{
  double force    = 0.;    ///< lambda_i / nr_i [force], >= 0 pushes apart
  double pressure = 0.;    ///< force / tributary area [force/length^(dim-1)]
  double gap      = 0.;    ///< left after deformation [length], >= 0
  double area     = 0.;    ///< tributary [length^(dim-1)]
  bool   active   = false; ///< in the active set
  bool   strong   = false; ///< force above the strong tolerance
  bool   weak     = false; ///< neither force nor gap
};

/// How far a state goes where the model is linear; see assumptions.h.
struct Assumptions
{
  double rotation = 0.; ///< largest of a cell [rad]
  double strain   = 0.; ///< largest of a cell
  double slip     = 0.; ///< largest of an active contact, in faces
  double drift    = 0.; ///< largest of a design off its pairing, in faces
  /// least of a patch that is not light, see ContactPatch
  double width = std::numeric_limits<double>::infinity();
  /// of the pair that sees the highest facets instead of what they stand for, by the gaps it
  /// closes: their height and these [length]
  double facet_height = 0., closed_gap = 0.;
  /// largest of a node, as a part of the largest distance of a node from the origin, whose
  /// rounding gaps may have
  double displacement = 0.;
};

/// A force and a moment, which in the plane has one component, the last
/// [force length], about a centre.
template <int dim>
struct Reaction
{
  std::string            name; ///< "body.boundary"
  dealii::Tensor<1, dim> centre, force;
  dealii::Tensor<1, 3>   moment;
};

/// The contact rows of one pair, summed up.
template <int dim>
struct PairState
{
  std::string            name;              ///< "slave: master"
  dealii::Tensor<1, dim> force;             ///< on the slave side [force]
  dealii::Tensor<1, 3>   moment;            ///< the same, about the centre
  dealii::Tensor<1, dim> centre;            ///< the point of an obstacle, else mean place by force
  dealii::Tensor<1, dim> peak;              ///< where the pressure is largest
  double                 peak_size    = 0.; ///< of the slave faces there [length]
  double                 contact_area = 0.; ///< of active rows [length^2]
  double                 max_pressure = 0.;
  unsigned int           rows = 0, active_contacts = 0;
};

/**
 * The solution of the contact problem at one geometry. Fields are on the
 * local nodes (valid at nodes of owned cells), contact points on all
 * ranks in the order of the contact rows.
 */
template <int dim>
struct ContactState
{
  using Field = typename mesh::BodyMesh<dim>::Field;

  unsigned int                load_case = 0;
  unsigned int                pairing   = 0; ///< how often contact was paired anew before
  Field                       positions;     ///< [length]
  Field                       displacement;  ///< continuous, see make_continuous() [length]
  feti::PrimalVectors         u;             ///< per subdomain
  qp::DualSolution            dual;
  std::vector<ContactPoint>   contact;
  std::vector<PairState<dim>> pairs;
  /// of the supports on the bodies, about the means of their nodes; of
  /// sections of revolution, the force along the axis
  std::vector<Reaction<dim>> reactions;
  dealii::Tensor<1, dim>     load;    ///< all loads together [force]
  dealii::Tensor<1, dim>     balance; ///< with what supports and obstacles do

  double                 least_scaled_jacobian = 1.; ///< of all cells
  double                 energy                = 0.; ///< 1/2 u'Ku - f'u
  double                 compliance            = 0.; ///< f'u
  double                 strain_energy         = 0.; ///< 1/2 u'Ku
  dealii::Tensor<1, dim> contact_force;              ///< on the slave sides [force]
  double                 contact_area    = 0.;       ///< of active rows
  double                 max_pressure    = 0.;
  unsigned int           active_contacts = 0;
  unsigned int           weak_contacts   = 0;
  /// least of max(lambda_i / max lambda, |gap_i| / max F_ii lambda_i), the
  /// distance from a weakly active contact; infinite without contacts
  double        degeneracy_distance = std::numeric_limits<double>::infinity();
  double        solved_to           = 0.; ///< relative KKT residual asked of the solver
  double        tolerance           = 0.; ///< relative, that the certificate meets
  unsigned long f_mults             = 0;  ///< of the contact solve
  unsigned long linear_f_mults      = 0;  ///< 0: not asked for
  Certificate   certificate;
  Assumptions   assumptions;
  /// one line per body that supports and strong contacts leave free to move:
  /// balanced, but where it is along these motions is not determined
  std::vector<std::string> free_bodies;
};
} // namespace snug::state

#endif
