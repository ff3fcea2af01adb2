#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/elasticity/linear_traction.h>
#include <snug/state/body_boxes.h>
#include <snug/state/reference_points.h>
#include <snug/state/rigid_modes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::state {
namespace {
/// Return theta of the motion q of a point.
template <int dim>
dealii::Tensor<1, 3> rotation(const std::vector<double> &q, const double length)
{
  dealii::Tensor<1, 3> theta;
  for (unsigned int k = dim; k < q.size(); ++k)
    theta[dim == 2 ? 2 : k - dim] = q[k] / length;
  return theta;
}

/// Return R q of one node.
template <int dim>
dealii::Tensor<1, dim> times_motion(const qp::MultiVector &R, const std::vector<double> &q)
{
  dealii::Tensor<1, dim> result;
  for (unsigned int k = 0; k < R.n_columns(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      result[c] += R(c, k) * q[k];
  return result;
}

/// Add -R'c to the entries.
template <int dim>
void subtract(const qp::MultiVector &R, const dealii::Tensor<1, dim> &c, PointEntries &entries)
{
  for (unsigned int k = 0; k < R.n_columns(); ++k)
    for (unsigned int d = 0; d < dim; ++d)
      entries.values[k] -= R(d, k) * c[d];
}
} // namespace

template <int dim>
ReferencePoints<dim>::ReferencePoints(const mesh::BodyMesh<dim> &mesh,
                                      const mesh::Surface<dim>  &surface,
                                      const Model<dim>          &model)
  : mesh(mesh), model(model), surface(surface)
{
  const auto                none = narrow<unsigned int>(model.points.size());
  std::vector<unsigned int> point_of(surface.n_nodes(), none);
  for (unsigned int p = 0; p < none; ++p)
    for (const auto &face : surface.faces())
      {
        const auto &faces = model.points[p].faces;
        if (std::find(faces.begin(), faces.end(), std::make_pair(face.body, face.boundary)) ==
            faces.end())
          continue;
        for (const unsigned int node : face.nodes)
          {
            // Hanging nodes follow their masters.
            if (!surface.masters(node).empty() || point_of[node] == p)
              continue;
            if (point_of[node] != none)
              throw InputError("the faces that follow the reference points '" +
                               model.points[point_of[node]].name + "' and '" +
                               model.points[p].name + "' have common nodes");
            point_of[node] = p;
          }
      }
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (point_of[node] != none)
      nodes.emplace_back(node, point_of[node]);
}

template <int dim>
bool ReferencePoints<dim>::moves(const std::string &obstacle) const
{
  return std::any_of(model.points.begin(), model.points.end(), [&](const auto &point) {
    return std::find(point.obstacles.begin(), point.obstacles.end(), obstacle) !=
           point.obstacles.end();
  });
}

template <int dim>
bool ReferencePoints<dim>::moves(const unsigned int body, const unsigned int boundary) const
{
  return std::any_of(model.points.begin(), model.points.end(), [&](const auto &point) {
    return std::find(point.faces.begin(), point.faces.end(), std::make_pair(body, boundary)) !=
           point.faces.end();
  });
}

template <int dim>
std::vector<contact::Row<dim>> ReferencePoints<dim>::rows() const
{
  std::vector<contact::Row<dim>> result;
  for (const auto &of_node : nodes)
    for (unsigned int c = 0; c < dim; ++c)
      {
        contact::Row<dim> row;
        row.normal[c]    = 1.;
        row.coefficients = {{of_node.first, row.normal}};
        result.push_back(row);
      }
  return result;
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
ReferencePoints<dim>::points_of_rows(const RowCoefficients<dim>  &rows,
                                     const contact::Contact<dim> &contact) const
{
  std::vector<std::pair<unsigned int, unsigned int>> result;
  const auto add_obstacle = [&](const unsigned int row, const unsigned int normal_row) {
    const auto &obstacle = contact.pairs()[contact.places()[normal_row].pair].obstacle;
    for (unsigned int p = 0; obstacle && p < model.points.size(); ++p)
      {
        const auto &names = model.points[p].obstacles;
        if (std::find(names.begin(), names.end(), obstacle->name) != names.end())
          result.emplace_back(row, p);
      }
  };
  for (unsigned int i = 0; i < contact.n_rows(); ++i)
    add_obstacle(i, i);
  for (unsigned int i = 0; i < contact.tangents().size(); ++i)
    add_obstacle(contact.n_rows() + i, contact.tangents()[i].row);
  const auto first = narrow<unsigned int>(rows.n_rows() - rows.followers.size());
  for (unsigned int i = 0; i < rows.followers.size(); ++i)
    result.emplace_back(first + i, nodes[i / dim].second);
  return result;
}

template <int dim>
qp::MultiVector ReferencePoints<dim>::motions(const unsigned int            point,
                                              const dealii::Tensor<1, dim> &x) const
{
  return rigid_motions<dim>(mesh.idealization(), {x}, model.points[point].place,
                            model.points[point].length);
}

template <int dim>
std::vector<PointEntries> ReferencePoints<dim>::entries(const Field                 &x,
                                                        const RowCoefficients<dim>  &rows,
                                                        const contact::Contact<dim> &contact) const
{
  std::vector<PointEntries> result;
  for (const auto &[row, point] : points_of_rows(rows, contact))
    {
      result.push_back({row, point, {}});
      for (const auto &[node, c] : rows.row(row).coefficients)
        subtract(motions(point, x[node]), c, result.back());
    }
  return result;
}

template <int dim>
void ReferencePoints<dim>::differentiate(const Field                 &x,
                                         const Field                 &v,
                                         const RowCoefficients<dim>  &rows,
                                         const contact::Contact<dim> &contact,
                                         RowCoefficients<dim>        &derivatives) const
{
  derivatives.followers = this->rows();
  for (auto &row : derivatives.followers)
    row.coefficients[0].second = {};
  auto &result = derivatives.points;
  result.clear();
  for (const auto &[row, point] : points_of_rows(rows, contact))
    {
      result.push_back({row, point, {}});
      const auto &of_row = rows.row(row).coefficients;
      for (unsigned int a = 0; a < of_row.size(); ++a)
        {
          const auto &[node, c] = of_row[a];
          subtract(motions(point, x[node]), derivatives.row(row).coefficients[a].second,
                   result.back());
          // Rotations are linear in x - p, and translations do not depend on it.
          auto change = motions(point, model.points[point].place + v[node]);
          for (unsigned int k = 0; k < std::min<unsigned int>(dim, change.n_columns()); ++k)
            std::fill_n(change.column(k), change.n_rows(), 0.);
          subtract(change, c, result.back());
        }
    }
}

/// Add the terms of c' and of x' in c . (theta x (x - p)).
template <int dim>
typename ReferencePoints<dim>::Field
ReferencePoints<dim>::energy_gradient(const Field                            &x,
                                      const std::vector<std::vector<double>> &q,
                                      const std::vector<double>              &forces,
                                      const RowCoefficients<dim>             &rows,
                                      const contact::Contact<dim>            &contact) const
{
  Field      result(x.size());
  const auto n = rows.contact.size() + rows.tangents.size();
  for (unsigned int p = 0; p < model.points.size(); ++p)
    {
      const auto          theta = rotation<dim>(q[p], model.points[p].length);
      std::vector<double> of_contact(n, 0.);
      for (const auto &[row, point] : points_of_rows(rows, contact))
        if (point == p)
          {
            if (row < n)
              of_contact[row] = forces[row];
            for (const auto &[node, c] : rows.row(row).coefficients)
              result[node] += forces[row] * elasticity::turned(theta, c);
          }
      if (std::all_of(of_contact.begin(), of_contact.end(), [](double f) { return f == 0.; }))
        continue;
      Field moved(surface.n_nodes());
      for (unsigned int node = 0; node < moved.size(); ++node)
        moved[node] = times_motion<dim>(motions(p, x[node]), q[p]);
      const auto of_rows =
        contact.coefficient_gradient(x, moved, contact.forces(rows.contact, of_contact));
      for (unsigned int node = 0; node < x.size(); ++node)
        result[node] -= of_rows[node];
    }
  return result;
}

template <int dim>
double ReferencePoints<dim>::parting(const Field                            &x,
                                     const Field                            &displacement,
                                     const std::vector<std::vector<double>> &q,
                                     std::string                            &name) const
{
  double largest = 0.;
  for (const auto &[node, p] : nodes)
    {
      const double distance =
        (displacement[node] - times_motion<dim>(motions(p, x[node]), q[p])).norm();
      if (distance > largest)
        name = model.points[p].name;
      largest = std::max(largest, distance);
    }
  return largest;
}

template <int dim>
mesh::Tearing
with_points(mesh::Tearing tearing, const mesh::BodyMesh<dim> &mesh, const Model<dim> &model)
{
  const auto n = narrow<unsigned int>(model.points.size());
  if (tearing.n_points == n)
    return tearing;
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(mesh.communicator());
  if (dealii::Utilities::MPI::this_mpi_process(mesh.communicator()) == n_ranks - 1)
    for (unsigned int p = 0; p < n; ++p)
      tearing.subdomains.push_back({mesh.n_bodies() + p, {}, {}});
  tearing.n_points = n;
  tearing.n_global += n;
  tearing.first_id_of_rank.back() += n;
  return tearing;
}

template <int dim>
Model<dim> with_lengths(Model<dim> model, const mesh::BodyMesh<dim> &mesh)
{
  if (model.points.empty())
    return model;
  double length = 0.;
  for (const auto &box : body_boxes(mesh))
    length = std::max(length, box.length);
  for (auto &point : model.points)
    point.length = length;
  return model;
}

#define SNUG_INSTANTIATE(dim)                                                    \
  template class ReferencePoints<dim>;                                           \
  template mesh::Tearing with_points(mesh::Tearing, const mesh::BodyMesh<dim> &, \
                                     const Model<dim> &);                        \
  template Model<dim>    with_lengths(Model<dim>, const mesh::BodyMesh<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
