#include <snug/geometry/formula.h>
#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>

#include <algorithm>
#include <cmath>

namespace snug::scene {
namespace {
/// Checks the mesh entries of one body.
class MeshCheck : public SectionCheck
{
public:
  MeshCheck(const Scene &scene, const Body &body, const Origins &origins)
    : SectionCheck(body.section(), origins)
    , dimension(scene.dimension)
    , model(scene.model)
    , body(body)
    , mesh(body.mesh)
  {}

  void check_box() const
  {
    require_length("Box corner", mesh.corner);
    require_length("Box size", mesh.size);
    require_length("Box cells", mesh.cells);
    require_length("Box grading", mesh.grading);
    require_length("Box fine length", mesh.fine_length);
    require(all_finite(mesh.corner), "Box corner", to_text(mesh.corner), "must be finite");
    require_positive("Box size", mesh.size);
    require_positive("Box grading", mesh.grading);
    require(std::count(mesh.cells.begin(), mesh.cells.end(), 0U) == 0, "Box cells",
            to_text(mesh.cells), "must be at least 1 each");
    double cells = 1.;
    for (const unsigned int n : mesh.cells)
      cells *= n;
    check_coarse(cells, "Box cells", to_text(mesh.cells));
  }

  /// The mesh can be made of its entries and is not too large.
  void check_geometry() const
  {
    if (dimension == 2)
      check_geometry_in<2>();
    else
      check_geometry_in<3>();
  }

  void check_local_refinement() const
  {
    require(mesh.local_refinements <= 15, "Local refinements", to_text(mesh.local_refinements),
            "must be at most 15");
    require(mesh.local_refinements == 0 || !mesh.refine_where.empty(), "Refine where",
            mesh.refine_where,
            "must be a formula of x, y, z when there are local "
            "refinements");
  }

private:
  template <int dim>
  void check_geometry_in() const
  {
    const auto geometry = made([&]() {
      if (!mesh.refine_where.empty())
        geometry::Formula<dim>("Refine where", mesh.refine_where);
      return geometry::make_geometry<dim>(mesh);
    });
    made([&]() { evaluate_ends(*geometry); });
    check_size(geometry->n_coarse_cells());
    if (model == "axisymmetric")
      check_radius(made([&]() { return least_radius(*geometry); }));
  }

  /// What @p make makes of the entries, of which its errors are.
  template <typename Make>
  auto made(const Make &make) const
  {
    try
      {
        return make();
      }
    catch (const InputError &error)
      {
        throw mesh_error(body, origins, error.what());
      }
  }

  /// Every rank holds all coarse cells.
  void check_coarse(const double cells, const std::string &entry, const std::string &value) const
  {
    require(cells <= 4e6, entry, value, "must give at most 4e6 cells; use 'Refinements' for more");
  }

  void check_size(const double cells) const
  {
    if (mesh.source == "file")
      check_coarse(cells, "Mesh file", mesh.file);
    else
      check_coarse(cells, "Cells", to_text(mesh.round_cells));
    // p4est numbers at most 2^31 nodes.
    require(mesh.refinements < 30 && cells * std::pow(2., dimension * mesh.refinements) <= 1e9,
            "Refinements", to_text(mesh.refinements), "must give at most 1e9 cells");
  }

  /// Formulas of positions are finite at two vertices of each cell, which
  /// are most; they are evaluated at all nodes once there is a mesh.
  template <int dim>
  void evaluate_ends(const geometry::BodyGeometry<dim> &geometry) const
  {
    if (mesh.warp.empty() && mesh.curved_faces.empty())
      return;
    dealii::Point<dim> ends[2];
    for (unsigned int d = 0; d < dim; ++d)
      ends[1][d] = 1.;
    for (unsigned int cell = 0; cell < geometry.n_coarse_cells(); ++cell)
      for (const auto &end : ends)
        geometry.position({cell, end});
  }

  /// The least x, the radius, of the vertices; 0 if only round-off is
  /// below. The nodes between them, of curved faces, are checked once
  /// there is a mesh.
  template <int dim>
  static double least_radius(const geometry::BodyGeometry<dim> &geometry)
  {
    double least = 0., largest = 0.;
    for (unsigned int cell = 0; cell < geometry.n_coarse_cells(); ++cell)
      for (unsigned int v = 0; v < 1 << dim; ++v)
        {
          dealii::Point<dim> unit;
          for (unsigned int d = 0; d < dim; ++d)
            unit[d] = v >> d & 1;
          const double x = geometry.position({cell, unit})[0];
          least          = std::min(least, x);
          largest        = std::max(largest, x);
        }
    const double round_off = 1e-10;
    return least < -round_off * largest ? least : 0.;
  }

  void check_radius(const double least) const
  {
    const std::string allowed = "must not lead to a negative x, the radius of axisymmetric models, "
                                "but does to " +
                                to_text(least);
    const bool moved = !mesh.shift.empty() && mesh.shift[0] < 0.;
    const bool box   = mesh.source == "box" && mesh.corner[0] < 0.;
    require(least >= 0. || !moved, "Shift", to_text(mesh.shift), allowed);
    require(least >= 0. || !box, "Box corner", to_text(mesh.corner), allowed);
    require(least >= 0., "Mesh", mesh.source, allowed);
  }

  template <typename T>
  void require_length(const std::string &entry, const std::vector<T> &values) const
  {
    require(values.size() == dimension, entry, to_text(values),
            "must have " + to_text(dimension) + " numbers separated by commas, one per dimension");
  }

  void require_positive(const std::string &entry, const std::vector<double> &values) const
  {
    require(all_finite(values) &&
              std::all_of(values.begin(), values.end(), [](const double v) { return v > 0.; }),
            entry, to_text(values), "must be positive");
  }

  unsigned int                        dimension;
  const std::string                  &model;
  const Body                         &body;
  const geometry::BodyMeshParameters &mesh;
};
} // namespace

InputError mesh_error(const Body &body, const Origins &origins, const std::string &message)
{
  const std::string section = body.section() + "/";
  const std::string begin   = "entry '";
  const auto        quote   = message.find('\'', begin.size());
  if (message.rfind(begin, 0) != 0 || quote == std::string::npos)
    return origins.error(section + "Mesh", body.mesh.source, message);
  const std::string entry = section + message.substr(begin.size(), quote - begin.size());
  return InputError(origins.of(entry) + begin + entry + message.substr(quote));
}

void check_mesh(const Scene &scene, const Body &body, const Origins &origins)
{
  const MeshCheck check(scene, body, origins);
  if (body.mesh.source == "box")
    check.check_box();
  check.check_geometry();
  check.check_local_refinement();
}
} // namespace snug::scene
