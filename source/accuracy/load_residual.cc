#include <snug/accuracy/load_residual.h>
#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/targets.h>
#include <snug/base/run_context.h>
#include <snug/contact/pair_geometry.h>
#include <snug/elasticity/cell_point.h>
#include <snug/faces/face_shape.h>
#include <snug/mesh/refined_cells.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace snug::accuracy {
namespace {
template <int dim>
using Shapes = std::vector<mesh::LagrangePoint<dim>>;

/// Return the Gauss points of the mesh in each of @p n parts per direction.
template <int dim>
const Shapes<dim> &
composite(const unsigned int degree, const unsigned int n, std::map<unsigned int, Shapes<dim>> &of)
{
  auto &shapes = of[n];
  if (shapes.empty())
    {
      const dealii::QIterated<dim> rule(dealii::QGauss<1>(degree + 1), n);
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          shapes.push_back(mesh::lagrange_point<dim>(degree, rule.point(q)));
          shapes.back().weight = rule.weight(q);
        }
    }
  return shapes;
}

template <int dim>
std::vector<dealii::Tensor<1, dim>> at(const std::vector<unsigned int>           &nodes,
                                       const std::vector<dealii::Tensor<1, dim>> &field)
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const unsigned int node : nodes)
    result.push_back(field[node]);
  return result;
}

template <int dim>
dealii::Tensor<1, dim> mean(const std::vector<double>                 &weights,
                            const std::vector<dealii::Tensor<1, dim>> &values)
{
  dealii::Tensor<1, dim> sum;
  for (unsigned int a = 0; a < values.size(); ++a)
    sum += weights[a] * values[a];
  return sum;
}

/// Nodal forces of a density, and the integral of its absolute value.
template <int dim>
struct Integral
{
  std::vector<dealii::Tensor<1, dim>> forces;
  double                              size = 0.;

  void add(const std::vector<double> &shape, const dealii::Tensor<1, dim> &force)
  {
    forces.resize(shape.size());
    for (unsigned int a = 0; a < shape.size(); ++a)
      forces[a] += shape[a] * force;
    size += force.norm();
  }
};

/// Return the forces of @p fine minus those of @p given.
template <int dim>
std::vector<dealii::Tensor<1, dim>> difference(Integral<dim> fine, const Integral<dim> &given)
{
  for (unsigned int a = 0; a < given.forces.size(); ++a)
    fine.forces[a] -= given.forces[a];
  return fine.forces;
}
} // namespace

template <int dim>
std::function<unsigned int(unsigned int level)> samples_of_level(const mesh::BodyMesh<dim> &mesh,
                                                                 const Sampling sampling)
{
  const unsigned int n_least = dim == 2 ? 16 : 4;
  unsigned int       n_most  = n_least;
  if (sampling == Sampling::search)
    {
      const double n_points = 2e5; // of all faces in 3D, about
      const double n_faces =
        dealii::Utilities::MPI::sum(double(mesh.boundary_faces().size()), mesh.communicator());
      n_most = dim == 2 ? 256 : std::min(64., std::sqrt(n_points / n_faces));
    }
  return [n_least, n_most](const unsigned int level) { return std::max(n_least, n_most >> level); };
}

template <int dim>
LoadResidual<dim>::LoadResidual(const mesh::BodyMesh<dim>  &mesh,
                                const state::LoadCase<dim> &loads,
                                const Field                &positions,
                                const Sampling              sampling)
  : mesh(mesh)
{
  for (unsigned int body = 0; body < loads.bodies.size(); ++body)
    {
      for (const auto &[boundary, load] : loads.bodies[body].boundaries)
        if (load.pressure || load.traction)
          keys.emplace_back(body, boundary);
      if (loads.bodies[body].body_force)
        keys.emplace_back(body, no_boundary);
    }
  // Call throw_collectively(), because a formula may fail at a position that only one rank has.
  throw_collectively(mesh.communicator(), [&]() {
    add_faces(loads, positions, sampling);
    add_cells(loads, positions, sampling);
  });
}

template <int dim>
void LoadResidual<dim>::add_faces(const state::LoadCase<dim> &loads,
                                  const Field                &positions,
                                  const Sampling              sampling)
{
  const auto                              n_of = samples_of_level(mesh, sampling);
  std::map<unsigned int, Shapes<dim - 1>> rules;
  for (const auto &face : mesh.boundary_faces())
    {
      const Key key(face.body, face.boundary);
      if (!std::binary_search(keys.begin(), keys.end(), key))
        continue;
      const auto &load    = loads.bodies[face.body].boundaries.at(face.boundary);
      const auto  X       = at<dim>(face.nodes, mesh.reference_positions()),
                 x        = at<dim>(face.nodes, positions);
      const auto integral = [&](const unsigned int n) {
        Integral<dim> result;
        for (const auto &shape : composite<dim - 1>(mesh.degree(), n, rules))
          {
            const auto reference = dealii::Point<dim>(mean<dim>(shape.value, X));
            const auto area =
              shape.weight * mesh.idealization().weight(mean<dim>(shape.value, x)) *
              faces::area_vector(faces::tangents<dim>(shape, face.nodes, positions));
            result.add(shape.value, load.force_at(reference, area));
          }
        return result;
      };
      const auto fine = integral(n_of(mesh::level(mesh.cell_id(face.cell))));
      parts.push_back({key, face.cell, face.nodes, difference(fine, integral(1)), fine.size});
    }
}

template <int dim>
void LoadResidual<dim>::add_cells(const state::LoadCase<dim> &loads,
                                  const Field                &positions,
                                  const Sampling              sampling)
{
  const unsigned int                  n_least = dim == 2 ? 4 : 3, n_most = dim == 2 ? 32 : 8;
  std::map<unsigned int, Shapes<dim>> rules;
  for (unsigned int i = 0; i < mesh.cells().size(); ++i)
    {
      const auto &cell = mesh.cells()[i];
      const auto &load = loads.bodies[cell.body].body_force;
      if (!load)
        continue;
      const auto X        = at<dim>(cell.nodes, mesh.reference_positions()),
                 x        = at<dim>(cell.nodes, positions);
      const auto integral = [&](const unsigned int n) {
        Integral<dim> result;
        for (const auto &shape : composite<dim>(mesh.degree(), n, rules))
          result.add(shape.value, shape.weight * determinant(elasticity::jacobian(shape, x)) *
                                    mesh.idealization().weight(mean<dim>(shape.value, x)) *
                                    load(dealii::Point<dim>(mean<dim>(shape.value, X))));
        return result;
      };
      const unsigned int n    = sampling == Sampling::measure
                                  ? n_least
                                  : std::max(n_least, n_most >> mesh::level(mesh.cell_id(i)));
      const auto         fine = integral(n);
      parts.push_back(
        {Key(cell.body, no_boundary), i, cell.nodes, difference(fine, integral(1)), fine.size});
    }
}

template <int dim>
std::vector<double> LoadResidual<dim>::works(const Field &v) const
{
  std::vector<double> result(mesh.cells().size(), 0.);
  for (const auto &part : parts)
    for (unsigned int a = 0; a < part.nodes.size(); ++a)
      result[part.cell] += part.forces[a] * v[part.nodes[a]];
  return result;
}

template <int dim>
std::vector<typename LoadResidual<dim>::Entry>
LoadResidual<dim>::entries(const std::string              &what,
                           const std::vector<std::string> &body_names) const
{
  std::vector<Entry> result;
  for (const auto &key : keys)
    {
      const std::string boundary =
        key.second == no_boundary ? "" : mesh.geometry(key.first).boundary_names()[key.second];
      result.push_back({what + (boundary.empty() ? " in " : " on ") + body_names[key.first] +
                          (boundary.empty() ? "" : "." + boundary),
                        0., std::vector<double>(mesh.cells().size(), 0.)});
      double size = 0.;
      for (const auto &part : parts)
        if (part.entry == key)
          {
            size += part.size;
            for (const auto &force : part.forces)
              result.back().of_cells[part.cell] += force.norm();
          }
      size = dealii::Utilities::MPI::sum(size, mesh.communicator());
      for (double &of_cell : result.back().of_cells)
        {
          of_cell = size > 0. ? of_cell / size : 0.;
          result.back().missed += of_cell;
        }
      result.back().missed = dealii::Utilities::MPI::sum(result.back().missed, mesh.communicator());
    }
  return result;
}

/// Refine the cells with the maximum contributions, until their sum suffices.
template <int dim>
void add_cells(const mesh::BodyMesh<dim> &mesh,
               const std::vector<double> &of_cells,
               const double               missed,
               const double               share,
               Unresolved                &result)
{
  const auto ids   = mesh::all_cells(mesh);
  const auto flags = mark(mesh::gather_values(mesh, ids, of_cells), missed, share, {1, 0.9});
  for (unsigned int cell = 0; cell < ids.size(); ++cell)
    if (flags[cell])
      result.cells.push_back(ids[cell]);
}

std::string percent(const double part)
{
  std::ostringstream text;
  text.precision(2);
  text << 100. * part << " %";
  return text.str();
}

/// Maximum share of the volume of a body that lies beyond its interpolated surface.
const double unseen_part = 0.05;

namespace {
/// A formula of a model as the loads whose residual shows what the mesh misses of the formula.
template <int dim>
struct FormulaLoads
{
  std::string          what; ///< see LoadResidual::entries()
  state::LoadCase<dim> loads;
};

/// Return a density along the first axis.
template <int dim>
std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
along_axis(std::function<double(const dealii::Point<dim> &)> value)
{
  return [value = std::move(value)](const dealii::Point<dim> &x) {
    dealii::Tensor<1, dim> result;
    result[0] = value(x);
    return result;
  };
}

/// Return all formulas of a model. A formula of a boundary is a traction, and temperatures are body
/// forces.
template <int dim>
std::vector<FormulaLoads<dim>> formulas(const state::Model<dim> &model)
{
  std::vector<FormulaLoads<dim>> result;
  const auto add = [&](const std::string &what, const std::string &load_case) -> auto & {
    result.push_back({what, {load_case, std::vector<state::BodyLoads<dim>>(model.bodies.size())}});
    return result.back().loads.bodies;
  };
  for (const auto &load_case : model.load_cases)
    {
      result.push_back({"the loads", load_case});
      auto &bodies = add("the temperature", load_case.name);
      for (unsigned int body = 0; body < bodies.size(); ++body)
        if (load_case.bodies[body].temperature)
          bodies[body].body_force = along_axis<dim>(load_case.bodies[body].temperature);
    }
  for (const auto &support : model.supports)
    for (unsigned int c = 0; c < support.values.size(); ++c)
      if (support.values[c])
        add("the prescribed displacement", model.load_cases[c].name)[support.body]
          .boundaries[support.boundary]
          .traction = along_axis<dim>(support.values[c]);
  for (const auto &spring : model.springs)
    if (!spring.place)
      add("the stiffness of the spring", "")[spring.body].boundaries[spring.boundary].traction =
        along_axis<dim>(spring.stiffness);
  for (const auto &pair : model.pairs)
    if (pair.parameters.has_friction())
      // The slave, at whose nodes the formula counts, is chosen later.
      for (const auto *side : {&pair.slave, &pair.master})
        for (const auto &[body, boundary] : side->boundaries())
          add("the friction", "")[body].boundaries[boundary].traction =
            along_axis<dim>(contact::resistance<dim>(pair));
  return result;
}
} // namespace

template <int dim>
Unresolved
unresolved_data(const mesh::BodyMesh<dim> &mesh, const state::Model<dim> &model, const double share)
{
  Unresolved result;
  for (const auto &[what, loads] : formulas(model))
    for (const auto &entry :
         LoadResidual<dim>(mesh, loads, mesh.reference_positions(), Sampling::search)
           .entries(what, model.body_names))
      if (entry.missed > share)
        {
          add_cells(mesh, entry.of_cells, entry.missed, share, result);
          result.lines.push_back("the mesh does not resolve " + entry.name + ": " +
                                 percent(entry.missed) + " of its integral is missing" +
                                 (loads.name.empty() ? "" : " in load case " + loads.name));
        }
  const auto volumes = unseen_volumes(mesh);
  for (unsigned int body = 0; body < volumes.size(); ++body)
    if (volumes[body].missed > unseen_part)
      {
        add_cells(mesh, volumes[body].of_cells, volumes[body].missed, unseen_part, result);
        result.lines.push_back("the mesh does not resolve the surface of " +
                               model.body_names[body] + ": " + percent(volumes[body].missed) +
                               " of the volume is missing");
      }
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template std::function<unsigned int(unsigned int)> samples_of_level(const mesh::BodyMesh<dim> &, \
                                                                      Sampling);                   \
  template class LoadResidual<dim>;                                                                \
  template void       add_cells(const mesh::BodyMesh<dim> &, const std::vector<double> &, double,  \
                                double, Unresolved &);                                             \
  template Unresolved unresolved_data(const mesh::BodyMesh<dim> &, const state::Model<dim> &,      \
                                      double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
