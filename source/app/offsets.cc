#include <snug/app/offsets.h>
#include <snug/faces/nodal_normals.h>
#include <snug/optimization/dense_vectors.h>
#include <snug/state/rigid_modes.h>

#include <algorithm>
#include <set>

namespace snug::app {
namespace {
const unsigned int most_variables = 300;

/// Mean squares below this part of the mean square of a motion are zero: the motion need be a
/// design to 1 % only, because control points of curved faces approximate motions.
const double negligible = 1e-4;

using Boundaries = std::vector<contact::Boundary>;

/// This struct holds the nodes of boundaries with their normals, and computes the components of
/// rigid motions there.
template <int dim>
struct MovedNodes
{
  using Vector = dealii::Tensor<1, dim>;

  MovedNodes(const mesh::BodyMesh<dim> &mesh, const Boundaries &boundaries)
    : surface(mesh, boundaries)
  {
    std::vector<unsigned int> all(surface.faces().size());
    std::iota(all.begin(), all.end(), 0u);
    const faces::FaceShape<dim> shape(mesh.degree());
    normals =
      faces::NodalNormals<dim>(surface, all, shape, surface.reference_positions()).normals();
  }

  /// Return the components of motion @p k along @p directions.
  std::vector<double> along(const std::vector<Vector> &directions,
                            const Vector              &centre,
                            const double               length,
                            const unsigned int         k) const
  {
    const auto &x = surface.reference_positions();
    const auto  R =
      state::rigid_motions(surface.idealization(), std::vector<Vector>(x.begin(), x.begin() + n()),
                           centre, length);
    std::vector<double> result(n(), 0.);
    for (unsigned int node = 0; node < n(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        result[node] += directions[node][d] * R(dim * node + d, k);
    return result;
  }

  unsigned int n() const { return surface.n_nodes(); }

  mesh::Surface<dim>  surface;
  std::vector<Vector> normals;
};

/// Subtract from @p v its components along the orthonormal @p basis.
void project_out(const std::vector<std::vector<double>> &basis, std::vector<double> &v)
{
  for (unsigned int sweep = 0; sweep < 2; ++sweep) // twice because of round-off
    for (const auto &q : basis)
      optimization::add(v, -optimization::dot(q, v), q);
}

/// Return an orthonormal basis of the normal components of the moves of the nodes.
template <int dim>
std::vector<std::vector<double>> normal_moves(const shape::Shapes<dim> &shapes,
                                              const MovedNodes<dim>    &nodes)
{
  std::vector<std::vector<double>> basis;
  for (unsigned int j = 0; j < shapes.n_variables(); ++j)
    {
      const auto          moves = nodes.surface.gather(shapes.column(j));
      std::vector<double> v;
      for (unsigned int node = 0; node < nodes.n(); ++node)
        v.push_back(moves[node] * nodes.normals[node]);
      const double size = optimization::dot(v, v);
      project_out(basis, v);
      const double left = optimization::dot(v, v);
      if (left <= 1e-16 * size || size == 0.)
        continue;
      for (double &component : v)
        component /= std::sqrt(left);
      basis.push_back(v);
    }
  return basis;
}

/// Return the bodies that may be displaced: each set has contact on the shaped faces of @p body
/// alone. The first set is the body itself, the second one the bodies that touch the faces.
std::vector<std::set<unsigned int>> displaced_bodies(const std::vector<contact::Pair> &pairs,
                                                     const unsigned int                body,
                                                     const Boundaries                 &shaped)
{
  const auto is_shaped = [&](const contact::Side &side) {
    return !side.boundaries().empty() && side.body() == body &&
           std::all_of(side.boundaries().begin(), side.boundaries().end(), [&](const auto &own) {
             return std::find(shaped.begin(), shaped.end(), own) != shaped.end();
           });
  };
  bool                   self = false, others = true;
  bool                   only_shaped = true;
  std::set<unsigned int> partners;
  for (const auto &pair : pairs)
    {
      const bool has_slave = is_shaped(pair.slave), has_master = is_shaped(pair.master);
      if (!has_slave && !has_master)
        {
          only_shaped = only_shaped && pair.slave.body() != body &&
                        (pair.obstacle || pair.master.body() != body);
          continue;
        }
      self = true;
      if (pair.obstacle)
        others = false;
      else
        partners.insert((has_slave ? pair.master : pair.slave).body());
    }
  for (const auto &pair : pairs)
    if (!is_shaped(pair.slave) && !is_shaped(pair.master))
      others = others && partners.count(pair.slave.body()) == 0 &&
               (pair.obstacle || partners.count(pair.master.body()) == 0);
  std::vector<std::set<unsigned int>> result;
  if (self && only_shaped)
    result.push_back({body});
  if (others && !partners.empty() && partners.count(body) == 0)
    result.push_back(partners);
  return result;
}

/// Return the mean square of the component of a motion along the directions that supports hold.
template <int dim>
double held_square(const ShapeProblem<dim>      &problem,
                   const std::set<unsigned int> &bodies,
                   const dealii::Tensor<1, dim> &centre,
                   const double                  length,
                   const unsigned int            motion)
{
  double result = 0.;
  for (const auto &support : problem.solver->model().supports)
    {
      if (bodies.count(support.body) == 0)
        continue;
      const MovedNodes<dim> nodes(*problem.mesh, {{support.body, support.boundary}});
      auto                  directions = nodes.normals;
      for (unsigned int node = 0; node < nodes.n(); ++node)
        directions[node] = support.component.direction(nodes.surface.reference_positions()[node],
                                                       nodes.normals[node]);
      const auto held = nodes.along(directions, centre, length, motion);
      result += optimization::dot(held, held) / nodes.n();
    }
  return result;
}

std::string motion_name(const unsigned int dimension, const bool axisymmetric, unsigned int motion)
{
  const std::string axes = "xyz";
  if (axisymmetric)
    return "along y";
  if (motion < dimension)
    return std::string("along ") + axes[motion];
  return dimension == 2 ? "about z" : std::string("about ") + axes[motion - dimension];
}

/// Return the warning about a body with its shaped boundaries; empty: there is none.
template <int dim>
std::string
warning(const ShapeProblem<dim> &problem, const unsigned int body, const Boundaries &shaped)
{
  const MovedNodes<dim>  nodes(*problem.mesh, shaped);
  const auto             basis = normal_moves(*problem.shapes, nodes);
  const auto            &x     = nodes.surface.reference_positions();
  dealii::Tensor<1, dim> centre;
  double                 length = 0.;
  for (unsigned int node = 0; node < nodes.n(); ++node)
    centre += x[node] / double(nodes.n());
  for (unsigned int node = 0; node < nodes.n(); ++node)
    length = std::max(length, (x[node] - centre).norm());
  const auto &meaning = problem.mesh->idealization();
  for (const auto &bodies : displaced_bodies(problem.solver->model().pairs, body, shaped))
    {
      std::string motions, names;
      for (unsigned int k = 0; k < meaning.n_rigid_motions(); ++k)
        {
          auto         left  = nodes.along(nodes.normals, centre, length, k);
          const double whole = optimization::dot(left, left) / nodes.n();
          project_out(basis, left);
          if (whole > 1e-3 && optimization::dot(left, left) / nodes.n() < negligible * whole &&
              held_square(problem, bodies, centre, length, k) < negligible * whole)
            motions +=
              (motions.empty() ? "" : " and ") + motion_name(dim, meaning.is_axisymmetric(), k);
        }
      for (const unsigned int other : bodies)
        names += (names.empty() ? "" : ", ") + problem.solver->model().body_names[other];
      if (!motions.empty())
        return "designs can move the shaped face of " + problem.solver->model().body_names[body] +
               " as a whole " + motions + "; this motion displaces " + names +
               " instead of changing the contact; set 'Fixed' for a control point, or add "
               "a constraint on the volume";
    }
  return "";
}
} // namespace

template <int dim>
std::vector<std::string> offset_warnings(const ShapeProblem<dim> &problem)
{
  const auto &scene = problem.scene;
  if (scene.task != scene::Task::optimize || problem.shapes->n_variables() > most_variables)
    return {};
  for (const auto &[name, limit] : scene.optimization.constraints)
    if (!problem.make_response(scene::constraint_name(scene, name).response)->needs_solution())
      return {};
  std::vector<std::string> result;
  const auto               faces = problem.shapes->faces();
  for (unsigned int body = 0; body < problem.mesh->n_bodies(); ++body)
    {
      Boundaries shaped;
      for (const auto &face : faces)
        if (face.first == body)
          shaped.push_back(face);
      if (shaped.empty())
        continue;
      if (const auto line = warning(problem, body, shaped); !line.empty())
        result.push_back(line);
    }
  return result;
}

template std::vector<std::string> offset_warnings(const ShapeProblem<2> &);
template std::vector<std::string> offset_warnings(const ShapeProblem<3> &);
} // namespace snug::app
