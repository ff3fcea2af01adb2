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
                                      const Model<dim>          &model,
                                      const Ties<dim>           &ties,
                                      const Field               &positions)
  : mesh(mesh), model(model), surface(surface), ties(ties), cuts(model.points.size())
{
  find_followers();
  for (unsigned int p = 0; p < model.points.size(); ++p)
    if (model.points[p].is_bolt())
      find_cut(p, positions);
}

/// Find the slave side of the tied pair of a bolt, and its mean normal.
template <int dim>
void ReferencePoints<dim>::find_cut(const unsigned int p, const Field &positions)
{
  const auto &contact = *ties.paired();
  const auto &cut     = model.points[p].cut;
  const auto  rows    = contact.rows(positions);
  const auto  areas   = contact.areas(positions);
  cuts[p].moved.assign(surface.n_nodes(), false);
  for (const auto &pair : contact.pairs())
    {
      cuts[p].pairs.push_back(false);
      for (const auto &face : surface.faces())
        if (contact::is_on(face, pair.slave) &&
            std::find(cut.begin(), cut.end(), std::make_pair(face.body, face.boundary)) !=
              cut.end())
          {
            cuts[p].pairs.back() = true;
            for (const unsigned int node : face.nodes)
              cuts[p].moved[node] = true;
          }
    }
  for (unsigned int i = 0; i < rows.size(); ++i)
    if (cuts[p].pairs[contact.places()[i].pair])
      cuts[p].axis += areas[i] * rows[i].normal;
  cuts[p].axis /= cuts[p].axis.norm();
}

template <int dim>
void ReferencePoints<dim>::find_followers()
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
std::optional<unsigned int> ReferencePoints<dim>::point_of(const std::string &obstacle) const
{
  for (unsigned int p = 0; p < model.points.size(); ++p)
    {
      const auto &names = model.points[p].obstacles;
      if (std::find(names.begin(), names.end(), obstacle) != names.end())
        return p;
    }
  return {};
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
    if (const auto p = obstacle ? point_of(obstacle->name) : std::nullopt)
      result.emplace_back(row, *p);
  };
  for (unsigned int i = 0; i < contact.n_rows(); ++i)
    add_obstacle(i, i);
  for (unsigned int i = 0; i < contact.tangents().size(); ++i)
    add_obstacle(contact.n_rows() + i, contact.tangents()[i].row);
  // The rows of ties are normal rows, then tangential rows that are not held.
  std::vector<unsigned int> pairs;
  if (!ties.empty())
    {
      const auto &places = ties.paired()->places();
      for (const auto &place : places)
        pairs.push_back(place.pair);
      for (const auto &tangent : ties.paired()->tangents())
        if (!tangent.is_held)
          pairs.push_back(places[tangent.row].pair);
    }
  const auto first_tie = narrow<unsigned int>(rows.contact.size() + rows.tangents.size());
  for (unsigned int i = 0; i < pairs.size(); ++i)
    for (unsigned int p = 0; p < model.points.size(); ++p)
      if (model.points[p].is_bolt() && cuts[p].pairs[pairs[i]])
        result.emplace_back(first_tie + i, p);
  const auto first = narrow<unsigned int>(rows.n_rows() - rows.followers.size());
  for (unsigned int i = 0; i < rows.followers.size(); ++i)
    result.emplace_back(first + i, nodes[i / dim].second);
  return result;
}

template <int dim>
qp::MultiVector ReferencePoints<dim>::motions(const unsigned int            point,
                                              const dealii::Tensor<1, dim> &x) const
{
  auto R = rigid_motions<dim>(mesh.idealization(), {x}, model.points[point].place,
                              model.points[point].length);
  for (unsigned int c = 0; c < dim && model.points[point].is_bolt(); ++c)
    R(c, 0) = cuts[point].axis[c];
  return R;
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
        if (moves_node(point, node))
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
          if (!moves_node(point, node))
            continue;
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
      std::vector<double> of_contact(n, 0.), of_ties(rows.ties.size(), 0.);
      for (const auto &[row, point] : points_of_rows(rows, contact))
        if (point == p)
          {
            if (row < n)
              of_contact[row] = forces[row];
            else if (row < n + of_ties.size())
              of_ties[row - n] = forces[row];
            for (const auto &[node, c] : rows.row(row).coefficients)
              if (moves_node(p, node))
                result[node] += forces[row] * elasticity::turned(theta, c);
          }
      Field moved(surface.n_nodes());
      for (unsigned int node = 0; node < moved.size(); ++node)
        if (moves_node(p, node))
          moved[node] = times_motion<dim>(motions(p, x[node]), q[p]);
      Field of_rows(x.size());
      if (model.points[p].is_bolt())
        of_rows = ties.energy_gradient(x, moved, of_ties);
      else if (!model.points[p].obstacles.empty())
        of_rows = contact.coefficient_gradient(x, moved, contact.forces(rows.contact, of_contact));
      for (unsigned int node = 0; node < x.size(); ++node)
        result[node] -= of_rows[node];
    }
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
ReferencePoints<dim>::motion_of(const contact::NamedPair               &pair,
                                const dealii::Tensor<1, dim>           &x,
                                const std::vector<std::vector<double>> &q) const
{
  if (const auto p = pair.obstacle ? point_of(pair.obstacle->name) : std::nullopt)
    return times_motion<dim>(motions(*p, x), q[*p]);
  return {};
}

template <int dim>
typename ReferencePoints<dim>::Field
ReferencePoints<dim>::without_bolts(const Field                            &x,
                                    Field                                   displacement,
                                    const std::vector<std::vector<double>> &q) const
{
  for (unsigned int p = 0; p < model.points.size(); ++p)
    for (unsigned int node = 0; model.points[p].is_bolt() && node < displacement.size(); ++node)
      if (cuts[p].moved[node])
        displacement[node] -= times_motion<dim>(motions(p, x[node]), q[p]);
  return displacement;
}

template <int dim>
double ReferencePoints<dim>::parting(const Field                               &x,
                                     const Field                               &displacement,
                                     const std::vector<std::vector<double>>    &q,
                                     const supports::DirichletConstraints<dim> &held,
                                     std::string                               &name) const
{
  double largest = 0.;
  for (const auto &[node, p] : nodes)
    {
      if (held.find(surface.global_node(node)) == held.n_nodes())
        continue;
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
