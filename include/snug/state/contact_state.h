#ifndef snug_state_contact_state_h
#define snug_state_contact_state_h

#include <snug/base/values.h>
#include <snug/feti/subdomain_system.h>
#include <snug/mesh/body_mesh.h>
#include <snug/mesh/surface.h>
#include <snug/qp/solver.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace snug::state {
/**
 * Relative errors of a solution, recomputed from K, f, B and g:
 * - Equilibrium is ||K u - f + B' lambda|| / (||f|| + ||B' lambda||), the maximum over bodies.
 * - Continuity is max|B_E u - D lambda - g_E| and penetration is max(B_I u - g_I)+, both over
 *   max_i(F_ii |lambda_i|, |f_i| / K_ii).
 * - Negative pressure is max(-lambda_I)+ over max lambda_I.
 * - Complementarity is |lambda' w| over the strain energy.
 *
 * With friction, for the slips s = w_T and the limits b of the cones (qp::FrictionCone), and with
 * the length c_F that continuity is compared with:
 * - Cone is max(|lambda_T| - b)+ / max b.
 * - Creep is max |s| (b - |lambda_T|)+ / (c_F max b): slip without the full friction force.
 * - Dissipation is sum(b |s| - lambda_T . s) over the strain energy: slip in another direction than
 *   that of the friction force.
 */
struct Certificate
{
  double equilibrium       = 0.;
  double continuity        = 0.;
  double penetration       = 0.;
  double negative_pressure = 0.;
  double complementarity   = 0.;
  double cone              = 0.;
  double creep             = 0.;
  double dissipation       = 0.;

  double worst() const;
};

/// Motion of a contact with friction along the surface.
enum class FrictionStatus
{
  none, ///< without friction
  open,
  stick,
  slip
};
inline Names names(FrictionStatus)
{
  return {{"none"}, {"open"}, {"stick"}, {"slip"}};
}

/// One contact of a state, in physical units.
struct ContactPoint
{
  double force    = 0.;    ///< lambda_i / nr_i [force]; forces >= 0 push apart
  double mean     = 0.;    ///< force / area [force/length^(dim-1)]; zero without an area
  double pressure = 0.;    ///< at the node, see nodal_pressures() [force/length^(dim-1)]
  double gap      = 0.;    ///< remaining gap after deformation [length], >= 0
  double area     = 0.;    ///< tributary area [length^(dim-1)]
  bool   active   = false; ///< in the active set
  bool   strong   = false; ///< force above the strong tolerance
  /// neither force nor gap, or at the limit of friction without a slip, within tolerances
  bool weak = false;

  /// @name Friction, in space
  /// @{
  FrictionStatus       friction = FrictionStatus::none;
  dealii::Tensor<1, 3> shear; ///< -shear acts on the slave side; along the slip [force]
  /// displacement of the slave side relative to the master, in this load step [length]
  dealii::Tensor<1, 3> slip;
  double               limit = 0.; ///< maximum of |shear| [force]
  /// at the node, along -shear and in the ratio of the pressure to the force
  /// [force/length^(dim-1)]
  dealii::Tensor<1, 3> traction;
  /// @}
};

/// Effect of large displacements on one body, which the linear model leaves out, see
/// geometric_effects().
struct GeometricEffect
{
  std::string body;
  double      energy   = 0.; ///< change of the energy over the energy
  double      rotation = 0.; ///< mean rotation that is left out of it [rad]

  /// Return the factor minus 1 of a force that is proportional to a displacement.
  double of_force() const { return 1.5 * energy; }
};

/// Quantities that show how far a state leaves the range of the linear model; see
/// validity_checks.h.
struct ValidityChecks
{
  double rotation = 0.; ///< maximum over cells [rad]
  double strain   = 0.; ///< maximum over cells
  double slip     = 0.; ///< maximum over active contacts, in faces
  double drift    = 0.; ///< maximum of the design off its pairing, in faces
  /// minimum over patches that are not light, see ContactPatch
  double width = std::numeric_limits<double>::infinity();
  /// height of unsmoothed facets and maximum gap closed [length], of the pair with the maximum
  /// ratio of this height to this gap
  double facet_height = 0., closed_gap = 0.;
  /// maximum over nodes, as a fraction of the maximum distance of a node from the origin, because
  /// gaps may have the round-off of this distance
  double displacement = 0.;
  /// slave nodes without a row, because they are beyond the search distance, that penetrate the
  /// master, and the name of a pair with such nodes
  unsigned int                 missed = 0;
  std::string                  missed_pair;
  std::vector<GeometricEffect> geometric; ///< per body
};

/// Force and moment about a centre. In the plane the moment [force length] has one component, the
/// last one.
template <int dim>
struct Reaction
{
  std::string            name; ///< "body.boundary"
  dealii::Tensor<1, dim> centre, force;
  dealii::Tensor<1, 3>   moment;
};

/// Motion of a reference point, and force and moment of its supports about the point.
template <int dim>
struct PointState
{
  std::string            name;
  dealii::Tensor<1, dim> place, displacement, force;
  dealii::Tensor<1, 3>   rotation, moment; ///< rotation [rad]
};

/// Tension and shortening of a bolt.
struct BoltState
{
  std::string name;
  double      tension = 0., shortening = 0.; ///< [force], [length]
};

/// Sums over the contact rows of one pair.
template <int dim>
struct PairState
{
  std::string            name;   ///< "slave: master"
  dealii::Tensor<1, dim> force;  ///< force on the slave side, with friction [force]
  dealii::Tensor<1, 3>   moment; ///< moment on the slave side about the centre
  dealii::Tensor<1, dim> centre; ///< point of an obstacle, else mean place weighted by force
  dealii::Tensor<1, dim> peak;   ///< position of the maximum pressure
  double                 peak_size    = 0.; ///< size of the slave faces at the peak [length]
  double                 contact_area = 0.; ///< area of active rows [length^2]
  double                 max_pressure = 0.;
  unsigned int           rows = 0, active_contacts = 0;
};

/// Sums and maxima over the rows of one tied pair.
template <int dim>
struct TieState
{
  std::string            name;   ///< "slave: master"
  dealii::Tensor<1, dim> force;  ///< that the pair transmits to the slave side [force]
  dealii::Tensor<1, 3>   moment; ///< to the slave side, about the centre
  dealii::Tensor<1, dim> centre; ///< mean place of the slave nodes, weighted by area
  double                 area = 0., max_tension = 0., max_shear = 0.;
  dealii::Tensor<1, dim> tension_place, shear_place; ///< slave nodes of the maxima
  unsigned int           nodes = 0;
};

/// Elastic stresses of a body compared with its yield stress, see stress_peaks().
struct YieldCheck
{
  double yield_stress = 0.; ///< minimum over the regions of the body that have one; 0: none
  double utilization  = 0.; ///< maximum of the von Mises stress over the yield stress of its region
  double volume       = 0.; ///< where the von Mises stress exceeds the yield stress [length^3]
  /// maximum distance from a point there to the contact faces of the body; NaN without any [length]
  double depth = 0.;
  /// maximum nodal pressure of the pairs of the body over the yield stress in shear, yield_stress /
  /// sqrt(3)
  double pressure_over_shear = 0.;
};

/// Maximum von Mises stress of a body, see stress_peaks().
template <int dim>
struct StressPeak
{
  std::string            body;
  double                 von_mises = 0.; ///< [force / length^2]
  dealii::Tensor<1, dim> place;          ///< in the undeformed body [length]
  YieldCheck             yield = {};

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive & body & von_mises & place;
  }
};

/// The displacement of the node that moves farthest, and its position in the undeformed body.
template <int dim>
struct DisplacementPeak
{
  double size = 0., extent = 0.; ///< extent: maximum distance of a node from the origin [length]
  dealii::Tensor<1, dim> displacement, position;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive & size & extent & displacement & position;
  }
};

/**
 * Solution of the contact problem at one geometry. Fields are given on the local nodes (valid at
 * nodes of owned cells). Contact points are given on all ranks in the order of the contact rows.
 */
template <int dim>
struct ContactState
{
  using Field = typename mesh::BodyMesh<dim>::Field;

  unsigned int load_case = 0;
  unsigned int pairing   = 0; ///< number of new contact searches before this state
  Field        positions;     ///< [length]
  Field        displacement;  ///< continuous, see make_continuous() [length]
  /// both at the nodes of the contact surface, on all ranks
  typename mesh::Surface<dim>::Field surface_positions, surface_displacement;
  feti::PrimalVectors                u; ///< per subdomain
  qp::DualSolution                   dual;
  /// slips of the tangential rows from the start of a sequence of load steps, then the motions of
  /// the reference points: before this step, or empty in the first step, and after it [length]
  std::vector<double>         slips_before, slips;
  std::vector<ContactPoint>   contact;
  std::vector<PairState<dim>> pairs;
  /// at the nodes of Ties::paired(): force, mean and pressure are negative in tension, and traction
  /// is the shear traction; no gap, slip and flags
  std::vector<ContactPoint>    tied;
  std::vector<TieState<dim>>   ties;   ///< per tied pair
  std::vector<PointState<dim>> points; ///< per reference point
  std::vector<BoltState>       bolts;
  /// reactions of the supports on the bodies, about the means of their nodes; for sections of
  /// revolution, the force along the axis
  std::vector<Reaction<dim>>   reactions;
  dealii::Tensor<1, dim>       load;         ///< sum of all loads [force]
  dealii::Tensor<1, dim>       balance;      ///< sum of loads, reactions and obstacle forces
  std::vector<StressPeak<dim>> stress_peaks; ///< per body
  DisplacementPeak<dim>        displacement_peak;

  double least_scaled_jacobian = 1.; ///< minimum over all cells
  /// @name Energies. Thermal strains enter the strain energy and are not among the loads f.
  /// @{
  double energy        = 0.; ///< potential energy: strain energy - f'u
  double compliance    = 0.; ///< f'u
  double strain_energy = 0.; ///< elastic energy: 1/2 u'Ku without thermal strains
  /// @}
  dealii::Tensor<1, dim> contact_force; ///< on the sides that the scene names first [force]
  double                 contact_area      = 0.; ///< area of active rows
  double                 max_pressure      = 0.;
  unsigned int           active_contacts   = 0;
  unsigned int           weak_contacts     = 0;
  unsigned int           slipping_contacts = 0;  ///< contacts with friction that slip
  double                 dissipation       = 0.; ///< sum of shear . slip, work of friction
  /// minimum of max(lambda_i / max lambda, |gap_i| / max F_ii lambda_i), which is the distance from
  /// a weakly active contact; infinite without contacts
  double contact_change_margin = std::numeric_limits<double>::infinity();
  /// minimum over closed contacts with friction of max(1 - |shear| / limit, |slip| / max F_ii
  /// lambda_i), which is the distance from a change between stick and slip
  double         friction_distance = std::numeric_limits<double>::infinity();
  double         solved_to         = 0.; ///< relative KKT residual requested from the solver
  double         tolerance         = 0.; ///< relative tolerance that the certificate meets
  unsigned long  f_mults           = 0;  ///< F-mults of the contact solve
  unsigned long  linear_f_mults    = 0;  ///< F-mults of a linear solve; 0: not requested
  Certificate    certificate;
  ValidityChecks validity;
  /// one line per body that supports and strong contacts leave free to move; the body is in
  /// equilibrium, but its position along these motions is not determined
  std::vector<std::string> free_bodies;

  /// Return the maximum of the peaks of the bodies.
  StressPeak<dim> stress_peak() const
  {
    StressPeak<dim> result;
    for (const auto &peak : stress_peaks)
      if (result.body.empty() || peak.von_mises > result.von_mises)
        result = peak;
    return result;
  }

  /// Return whether a contact may carry friction forces.
  bool has_friction() const
  {
    return std::any_of(contact.begin(), contact.end(), [](const ContactPoint &point) {
      return point.friction != FrictionStatus::none;
    });
  }
};
} // namespace snug::state

#endif
