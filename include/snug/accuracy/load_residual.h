#ifndef snug_accuracy_load_residual_h
#define snug_accuracy_load_residual_h

#include <snug/state/model.h>

#include <deal.II/grid/cell_id.h>

#include <functional>

namespace snug::accuracy {
/// Sampling density of formulas, in parts of a face or cell per direction.
enum class Sampling
{
  search, ///< resolves features of a hundredth of a coarse face
  measure ///< 16 times as many points as the mesh has on a face
};

/// Return the number of parts per direction of a face as a function of its level above its coarse
/// face. Collective.
template <int dim>
std::function<unsigned int(unsigned int level)> samples_of_level(const mesh::BodyMesh<dim> &mesh,
                                                                 Sampling sampling);

/**
 * The part of the loads that the quadrature of a mesh misses if pressures, tractions and body
 * forces are formulas: the nodal forces [force] of each face or cell
 *   r_a = sum_q w_q N_a(x_q) t(x_q) - f_a.
 * The sum extends over the Gauss points of many parts of the face, and f_a are the nodal forces of
 * the mesh.
 */
template <int dim>
class LoadResidual
{
public:
  using Field = mesh::Field<dim>;

  /// The mesh must outlive this object. Collective.
  LoadResidual(const mesh::BodyMesh<dim>  &mesh,
               const state::LoadCase<dim> &loads,
               const Field                &positions,
               Sampling                    sampling);

  /// Return r . v of each cell of this rank for a field @p v at all local nodes [force length].
  std::vector<double> works(const Field &v) const;

  /// A loaded boundary, or the body forces of a body.
  struct Entry
  {
    std::string         name;
    double              missed;   ///< sum of |r_a| over the sum of |t| dA
    std::vector<double> of_cells; ///< contributions of the cells of this rank
  };
  /// Return all entries, in the same order on all ranks, named "WHAT on BODY.BOUNDARY" or "WHAT in
  /// BODY" with @p what, such as "the loads". Collective.
  std::vector<Entry> entries(const std::string              &what,
                             const std::vector<std::string> &body_names) const;

private:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;
  using Key   = std::pair<unsigned int, unsigned int>; ///< body, boundary or no_boundary

  static constexpr unsigned int no_boundary = static_cast<unsigned int>(-1);

  struct Part
  {
    Key                       entry;
    unsigned int              cell;
    std::vector<unsigned int> nodes;  ///< local nodes
    Nodes                     forces; ///< r_a
    double                    size;   ///< int |t| dA
  };

  const mesh::BodyMesh<dim> &mesh;
  std::vector<Key>           keys; ///< ascending
  std::vector<Part>          parts;

  void add_faces(const state::LoadCase<dim> &loads, const Field &positions, Sampling sampling);
  void add_cells(const state::LoadCase<dim> &loads, const Field &positions, Sampling sampling);
};

/// Cells in which formulas are finer than the mesh, and descriptions of the unresolved formulas.
struct Unresolved
{
  std::vector<dealii::CellId> cells; ///< cells to refine, equal on all ranks
  std::vector<std::string>    lines; ///< descriptions of the unresolved formulas
};

/// Add the cells to refine until an error @p missed is at most @p share. @p of_cells are the
/// contributions of this rank's cells. Collective.
template <int dim>
void add_cells(const mesh::BodyMesh<dim> &mesh,
               const std::vector<double> &of_cells,
               double                     missed,
               double                     share,
               Unresolved                &result);

/// Return a share as text, like "12 %".
std::string percent(double part);

/// Return the cells to refine until the quadrature of the mesh misses at most the share @p share of
/// each formula of the model (loads, temperatures, prescribed displacements, springs, friction),
/// and the true surfaces miss at most 5 % of the volumes of the bodies. Collective.
template <int dim>
Unresolved
unresolved_data(const mesh::BodyMesh<dim> &mesh, const state::Model<dim> &model, double share);
} // namespace snug::accuracy

#endif
