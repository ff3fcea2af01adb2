#include <snug/advice/coarse_faces.h>
#include <snug/advice/cost.h>
#include <snug/base/errors.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/formula.h>
#include <snug/mesh/distribute.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace snug::advice {
namespace {
/// Counts of one body.
struct BodyCounts
{
  double                        cells, nodes, coarse_cells;
  std::map<std::string, double> boundary_nodes; ///< by boundary
  bool                          has_layers;
};

/// This class counts, on samples, the cells into which 'Refine where' divides the cells of a body.
template <int dim>
class LocalRefinement
{
public:
  LocalRefinement(const geometry::BodyMeshParameters &mesh,
                  const geometry::BodyGeometry<dim>  &geometry)
    : geometry(geometry)
    , formula("Refine where", mesh.refine_where)
    , levels(mesh.local_refinements)
    , per_axis(1 << mesh.refinements)
  {}

  static constexpr unsigned int no_face = 2 * dim;

  /// Mean number of cells that become of one in coarse cells or, of faces, on their faces.
  double mean(const std::vector<CoarseFace> &starts) const
  {
    const double each = std::pow(per_axis, starts.front().face == no_face ? dim : dim - 1);
    const double all = starts.size() * each, step = std::max(1., all / samples);
    double       sum = 0., n = 0.;
    for (double i = 0.5 * step; i < all; i += step, ++n)
      {
        const auto  &start = starts[unsigned(i / each)];
        Box          box{start.cell, {}, 1. / per_axis};
        unsigned int rest = unsigned(std::fmod(i, each));
        for (unsigned int d = 0; d < dim; ++d)
          if (d == start.face / 2)
            box.lower[d] = start.face % 2 == 0 ? 0. : 1. - box.size;
          else
            {
              box.lower[d] = box.size * (rest % per_axis);
              rest /= per_axis;
            }
        sum += leaves(box, start.face);
      }
    return sum / n;
  }

private:
  /// A refined cell within its coarse cell.
  struct Box
  {
    unsigned int       cell;
    dealii::Point<dim> lower;
    double             size;
    unsigned int       level = 0, delay = 0;
  };

  static constexpr double samples = 3000.;

  dealii::Point<dim> at(const Box &box, const dealii::Point<dim> &unit) const
  {
    dealii::Point<dim> in_coarse;
    for (unsigned int d = 0; d < dim; ++d)
      in_coarse[d] = box.lower[d] + box.size * unit[d];
    return geometry.position({box.cell, in_coarse});
  }

  /// Around the body there is nothing to refine, and no value to be had.
  bool is_positive(const dealii::Point<dim> &x) const
  {
    ++n_evaluations;
    try
      {
        return formula.value(x) > 0.;
      }
    catch (const InputError &)
      {
        return false;
      }
  }

  /// Neighbours differ by one level at most: a cell is refined too if the centres of cells that
  /// become the finest ones are nearer than the cells of the levels between are wide. Those are
  /// the ones that the formula has refined on each level.
  bool has_finer_neighbours(const Box &box, const dealii::Point<dim> &centre) const
  {
    if (box.level + 1 >= levels)
      return false;
    const unsigned int                  between = levels - box.level - 1;
    const double                        reach   = 1.5 * (1. - std::pow(0.5, between));
    std::vector<dealii::Tensor<1, dim>> axes;
    for (unsigned int d = 0; d < dim; ++d)
      {
        auto end = geometry::unit_centre<dim>();
        end[d]   = 1.;
        axes.push_back(2. * (at(box, end) - centre));
      }
    const auto all_refined = [&](const dealii::Tensor<1, dim> &off) {
      for (double size = 1., level = 0; level <= between; ++level, size /= 2.)
        {
          auto x = centre;
          for (unsigned int d = 0; d < dim; ++d)
            x += ((std::floor((off[d] + 0.5) / size) + 0.5) * size - 0.5) * axes[d];
          if (!is_positive(x))
            return false;
        }
      return true;
    };
    const unsigned int n_directions = dim == 2 ? 9 : 27;
    for (unsigned int i = 0; i < n_directions; ++i)
      for (const double part : {1., 0.7})
        {
          dealii::Tensor<1, dim> off;
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= 3)
            off[d] = part * reach * (rest % 3 - 1.);
          if (all_refined(off))
            return true;
        }
    return false;
  }

  /// All children as long as the samples last, then one for all of them. What neighbours refine is
  /// a step late, and has one step less to be refined itself.
  double leaves(const Box &box, const unsigned int face) const
  {
    if (box.level + box.delay >= levels)
      return 1.;
    const auto centre   = at(box, geometry::unit_centre<dim>());
    const bool positive = is_positive(centre);
    if (!positive && !has_finer_neighbours(box, centre))
      return 1.;
    const unsigned int n_children = face == no_face ? 1 << dim : 1 << (dim - 1);
    const double       budget     = 2e5;
    const bool         all        = n_evaluations < budget;
    const unsigned int only       = n_evaluations % n_children;
    double             sum        = 0.;
    for (unsigned int child = 0, i = 0; child < 1 << dim; ++child)
      {
        if (face != no_face && (child >> face / 2 & 1) != face % 2)
          continue;
        if (all || i == only)
          {
            Box half{box.cell, box.lower, 0.5 * box.size, box.level + 1, box.delay + !positive};
            for (unsigned int d = 0; d < dim; ++d)
              half.lower[d] += (child >> d & 1) * half.size;
            sum += leaves(half, face);
          }
        ++i;
      }
    return all ? sum : sum * n_children;
  }

  const geometry::BodyGeometry<dim> &geometry;
  geometry::Formula<dim>             formula;
  const unsigned int                 levels, per_axis;
  mutable unsigned int               n_evaluations = 0;
};

/// Return the number of nodes. By Euler's formula, the number is exact for evenly refined cells of
/// a body without holes. For other bodies, additional nodes are proportional to the cells.
template <int dim>
BodyCounts count_body(const scene::Body &body, const unsigned int degree)
{
  const auto   geometry = geometry::make_geometry<dim>(body.mesh);
  const auto   coarse   = geometry->coarse_mesh();
  const double m = degree * std::pow(2., body.mesh.refinements), cells = coarse.cells.size();
  const double V = coarse.vertices.size(), B = coarse.boundary_faces.size();
  const double sides = (2. * dim * cells + B) / 2.;
  const double edges = V + sides - cells - 1.; // in 3D; in 2D the sides are the edges
  BodyCounts   result;
  result.coarse_cells = cells;
  result.cells        = cells * std::pow(2., double(dim) * body.mesh.refinements);
  result.nodes =
    dim == 2 ? V + sides * (m - 1.) + cells * (m - 1.) * (m - 1.)
             : V + edges * (m - 1.) + sides * (m - 1.) * (m - 1.) + cells * std::pow(m - 1., 3);
  result.has_layers                          = geometry->has_grid();
  const auto                          &names = geometry->boundary_names();
  std::vector<std::vector<CoarseFace>> faces(names.size());
  for (const auto &face : coarse_faces<dim>(coarse))
    faces[face.boundary].push_back(face);
  for (unsigned int b = 0; b < names.size(); ++b)
    {
      std::set<unsigned int> vertices;
      for (const auto &face : faces[b])
        for (const unsigned int vertex : geometry::face_of<dim>(coarse.cells[face.cell], face.face))
          vertices.insert(vertex);
      const double n = vertices.size(), f = faces[b].size();
      result.boundary_nodes[names[b]] =
        dim == 2 ? n + f * (m - 1.) : n + (n + f - 1.) * (m - 1.) + f * (m - 1.) * (m - 1.);
    }
  if (body.mesh.refine_where.empty() || body.mesh.local_refinements == 0)
    return result;
  const LocalRefinement<dim> local(body.mesh, *geometry);
  std::vector<CoarseFace>    all;
  for (unsigned int cell = 0; cell < cells; ++cell)
    all.push_back({cell, LocalRefinement<dim>::no_face, 0});
  const double more = local.mean(all);
  result.nodes += (more - 1.) * result.cells * std::pow(degree, dim);
  result.cells *= more;
  result.has_layers = result.has_layers && more == 1.;
  for (unsigned int b = 0; b < names.size(); ++b)
    if (!faces[b].empty())
      result.boundary_nodes[names[b]] *= local.mean(faces[b]);
  return result;
}

template <int dim>
Counts count_in(const scene::Scene &scene, const unsigned int ranks)
{
  Counts              result;
  std::vector<double> cells, each;
  const auto          by_size = mesh::cells_per_subdomain(dim, scene.degree, idealization(scene));
  std::map<std::string, double> nodes_of_face;
  for (const auto &body : scene.bodies)
    {
      const auto of = count_body<dim>(body, scene.degree);
      for (const auto &[name, nodes] : of.boundary_nodes)
        nodes_of_face[body.name + "." + name] = nodes;
      cells.push_back(of.cells);
      each.push_back(
        (of.has_layers ? by_size.compact : by_size.other) *
        (scene::is_nearly_incompressible(scene, body) ? mesh::larger_subdomains(dim) : 1.));
      result.cells += of.cells;
      result.nodes += of.nodes;
      result.coarse_cells += of.coarse_cells;
      result.has_layers = result.has_layers && of.has_layers;
    }
  for (const auto &pair : scene.contact.pairs)
    {
      const auto nodes_of = [&](const std::string &side) {
        double sum = 0.; // of an obstacle
        for (const auto &face : contact::faces_of_side(side))
          if (const auto found = nodes_of_face.find(face); found != nodes_of_face.end())
            sum += found->second;
        return sum;
      };
      const bool either = pair.parameters.slave == contact::Slave::finer;
      result.contact_rows += std::max(nodes_of(pair.slave), either ? nodes_of(pair.master) : 0.);
    }
  if (scene.tearing.subdomains > 0)
    each.assign(cells.size(), result.cells / scene.tearing.subdomains);
  do
    {
      result.subdomains = 0.;
      for (unsigned int body = 0; body < cells.size(); ++body)
        {
          result.subdomains += std::max(1., std::round(cells[body] / each[body]));
          each[body] /= 2.;
        }
  } while (result.subdomains < std::min<double>(ranks, result.cells) && each.front() > 0.1);
  return result;
}
} // namespace

Counts count(const scene::Scene &scene, const unsigned int ranks)
{
  return scene.dimension == 2 ? count_in<2>(scene, ranks) : count_in<3>(scene, ranks);
}
} // namespace snug::advice
