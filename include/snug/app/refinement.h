#ifndef snug_app_refinement_h
#define snug_app_refinement_h

#include <snug/mesh/forest.h>
#include <snug/scene/scene.h>

#include <deal.II/grid/cell_id.h>

#include <map>
#include <set>

namespace snug::app {
/**
 * This class holds the refinement of a mesh beyond the entries of the scene. Bodies of CAD files
 * are meshed anew with smaller elements. The cells of other bodies are divided by p4est.
 */
class Refinement
{
public:
  /// Divide @p cell of a body, given by its id in the body alone, see CoarseCells::in_body().
  void divide(unsigned int body, const dealii::CellId &cell);

  /// Halve the element size of the CAD file of a body at places, or everywhere if there are none.
  /// @p after is the number of halvings before this one. Calls with equal @p after are one halving;
  /// their places are united.
  void halve(unsigned int body, unsigned int after, const std::vector<dealii::Point<3>> &places);

  /// Return how often the elements of the body are halved.
  unsigned int n_halvings(unsigned int body) const;

  bool empty() const { return divided.empty() && halved.empty(); }
  bool operator==(const Refinement &other) const
  {
    return divided == other.divided && halved == other.halved;
  }
  bool operator!=(const Refinement &other) const { return !(*this == other); }

  /// Mesh the CAD files of @p scene anew whose element sizes differ from these. Return whether
  /// there are any. Collective. @throws InputError.
  bool remesh(scene::Scene &scene, RunContext &context) const;

  /// Return the divided cells of all bodies, with their ids in a mesh of all bodies.
  template <int dim>
  std::set<dealii::CellId> cells(const geometry::CoarseCells<dim> &coarse) const;

private:
  using Halvings = std::vector<std::vector<dealii::Point<3>>>;

  std::map<unsigned int, std::set<dealii::CellId>> divided; ///< with their ancestors
  std::map<unsigned int, Halvings> halved; ///< see geometry::BodyMeshParameters::halved
};
} // namespace snug::app

#endif
