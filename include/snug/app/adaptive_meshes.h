#ifndef snug_app_adaptive_meshes_h
#define snug_app_adaptive_meshes_h

#include <snug/app/refinement.h>
#include <snug/base/run_context.h>
#include <snug/mesh/body_mesh.h>

#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace snug::app {
/**
 * This class makes the meshes of a scene with refinements. Each mesh is made from the forest of the
 * mesh before where that is possible. Contact faces that lie opposite to each other are kept at one
 * size. first(), make() and everywhere() are collective.
 */
template <int dim>
class AdaptiveMeshes
{
public:
  using Mesh = std::unique_ptr<mesh::BodyMesh<dim>>;

  /// Keep a reference to @p context and a copy of @p scene.
  AdaptiveMeshes(RunContext &context, const scene::Scene &scene)
    : context(context), the_scene(scene)
  {}

  /// Return the scene with the meshes of CAD files that were made last.
  const scene::Scene &scene() const { return the_scene; }

  /// Return the mesh of the scene with @p refinement. First add to @p refinement the cells that
  /// loads, surfaces and opposite contact faces need. Warn of loads and surfaces that remain
  /// unresolved. @throws InputError.
  Mesh first(Refinement &refinement);

  /// Return the mesh of the scene with @p refinement. First divide, by adding them to
  /// @p refinement, cells whose contact face is larger than the one opposite. @throws InputError.
  Mesh make(Refinement &refinement);

  /// Add cells @p marked of @p mesh to @p to. @p mesh must be the last one made, @p of_mesh its
  /// refinement. Elements of CAD files are halved at the centres of these cells if @p remesh_cad.
  void add_cells(const mesh::BodyMesh<dim>         &mesh,
                 const Refinement                  &of_mesh,
                 const std::vector<dealii::CellId> &marked,
                 Refinement                        &to,
                 bool                               remesh_cad = true) const;

  /// Return @p of_mesh with all cells of @p mesh divided and all elements halved, as far as the
  /// maximum level allows. Collective.
  Refinement everywhere(const mesh::BodyMesh<dim> &mesh, const Refinement &of_mesh) const;

  static unsigned long unknowns(const mesh::BodyMesh<dim> &mesh)
  {
    return dim * mesh.n_global_free_nodes();
  }

  /// Return whether a mesh has at most 'Maximum unknowns'.
  bool is_affordable(const mesh::BodyMesh<dim> &mesh) const
  {
    return double(unknowns(mesh)) <= the_scene.accuracy.maximum_unknowns;
  }

  /// Return the time at which the last mesh, or another solution on it, was begun [s].
  double start_time() const { return begun; }

  /// Begin another solution on the last mesh.
  void begin() { begun = context.seconds(); }

private:
  const mesh::Forest<dim> &forest_with(const Refinement &refinement);
  void                     resolve_data(Refinement &refinement);

  RunContext                        &context;
  scene::Scene                       the_scene;
  std::unique_ptr<mesh::Forest<dim>> forest;
  std::set<dealii::CellId>           forest_cells;     ///< cells refined in the forest
  std::optional<Refinement>          first_refinement; ///< of the first mesh of the scene
  double                             begun = 0.;       ///< see start_time()
};
} // namespace snug::app

#endif
