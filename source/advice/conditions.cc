#include <snug/advice/conditions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::advice {
namespace {
template <int dim>
dealii::Tensor<2, dim + 1> scalar_datum(const double s)
{
  dealii::Tensor<2, dim + 1> result;
  result[dim][dim] = s;
  return result;
}

template <int dim>
dealii::Tensor<2, dim + 1> tensor_datum(const dealii::Tensor<2, dim> &T)
{
  dealii::Tensor<2, dim + 1> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i][j] = T[i][j];
  return result;
}
} // namespace

template <int dim>
void Comparison<dim>::add(const double                  weight,
                          const dealii::Tensor<2, dim> &Q,
                          const PointData<dim>         &at_x,
                          const dealii::Tensor<1, dim> &x,
                          const PointData<dim>         &at_y,
                          const dealii::Tensor<1, dim> &y)
{
  const unsigned int n_functions = 4, n = (dim + 1) * (dim + 1);
  const auto         map = tensor_datum(Q) + scalar_datum<dim>(1.);
  differences.resize(n_functions * n * at_x.size(), 0.);
  sizes.resize(differences.size(), 0.);
  unsigned int place = 0;
  for (unsigned int k = 0; k < n_functions; ++k)
    {
      dealii::Tensor<1, dim> wave;
      for (unsigned int d = 0; d < dim; ++d)
        wave[d] = (1.5 + 0.85 * k + 1.15 * d) / length;
      const double at[] = {weight * std::cos(wave * x + k), weight * std::cos(wave * y + k)};
      for (unsigned int i = 0; i < at_x.size(); ++i)
        {
          const auto   difference = at[0] * (map * at_x[i] * transpose(map)) - at[1] * at_y[i];
          const double size       = weight * at_x[i].norm();
          for (unsigned int j = 0; j < n; ++j, ++place)
            {
              differences[place] += difference[j / (dim + 1)][j % (dim + 1)];
              sizes[place] += size;
            }
        }
    }
}

template <int dim>
bool Comparison<dim>::is_equal(MPI_Comm communicator) const
{
  // A rank may have no points.
  const unsigned int  n   = dealii::Utilities::MPI::max<unsigned int>(sizes.size(), communicator);
  std::vector<double> off = differences, all = sizes;
  off.resize(n, 0.);
  all.resize(n, 0.);
  dealii::Utilities::MPI::sum(off, communicator, off);
  dealii::Utilities::MPI::sum(all, communicator, all);
  return std::equal(off.begin(), off.end(), all.begin(),
                    [](const double o, const double a) { return std::abs(o) <= 1e-7 * a; });
}

template <int dim>
Conditions<dim>::Conditions(const AdviceInput<dim> &input) : input(input)
{
  const auto         &mesh = input.mesh();
  std::vector<double> sums(dim + 1, 0.);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.owner(node) == input.solver.context().rank())
      {
        for (unsigned int d = 0; d < dim; ++d)
          sums[d] += mesh.reference_positions()[node][d];
        sums[dim] += 1.;
      }
  dealii::Utilities::MPI::sum(sums, mesh.communicator(), sums);
  for (unsigned int d = 0; d < dim; ++d)
    mean[d] = sums[d] / sums[dim];
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    radius = std::max(radius, (mesh.reference_positions()[node] - mean).norm());
  radius = dealii::Utilities::MPI::max(radius, mesh.communicator());
  for (const auto &pair : input.model().pairs)
    {
      gaps.emplace_back("Gap", pair.parameters.gap);
      obstacles.push_back(pair.obstacle
                            ? choose(contact::obstacle_table<dim>(), pair.obstacle->shape)
                                .make(*pair.obstacle, 0.01 * size())
                            : nullptr);
    }
}

/// The centres alone would miss loads that are odd about the centres of all faces.
template <int dim>
std::vector<Place<dim>> Conditions<dim>::on_faces() const
{
  const double            towards_node = 0.7;
  const unsigned int      p            = input.mesh().degree();
  const auto             &X            = input.mesh().reference_positions();
  std::vector<Place<dim>> result;
  for (const auto &face : input.mesh().boundary_faces())
    {
      const auto &nodes = face.nodes;
      Place<dim>  centre{face.body, face.boundary};
      for (const unsigned int node : nodes)
        centre.x += X[node] / double(nodes.size());
      if constexpr (dim == 2)
        centre.normal = dealii::cross_product_2d(X[nodes[p]] - X[nodes[0]]);
      else
        centre.normal = dealii::cross_product_3d(X[nodes.back()] - X[nodes[0]],
                                                 X[nodes[p * (p + 1)]] - X[nodes[p]]);
      centre.weight = centre.normal.norm() / (nodes.size() + 1.);
      centre.normal /= centre.normal.norm();
      result.push_back(centre);
      for (const unsigned int node : nodes)
        {
          result.push_back(centre);
          result.back().x += towards_node * (X[node] - centre.x);
        }
    }
  return result;
}

template <int dim>
std::vector<Place<dim>> Conditions<dim>::in_cells() const
{
  const auto                    &mesh = input.mesh();
  const elasticity::Element<dim> element(mesh.degree());
  std::vector<Place<dim>>        result;
  for (const auto &cell : mesh.cells())
    {
      typename elasticity::Element<dim>::Nodes X;
      Place<dim>                               centre{cell.body};
      for (const unsigned int node : cell.nodes)
        {
          X.push_back(mesh.reference_positions()[node]);
          centre.x += X.back() / double(cell.nodes.size());
        }
      centre.weight   = element.volume(X);
      centre.material = &input.model().bodies[cell.body].material(cell);
      result.push_back(centre);
    }
  return result;
}

template <int dim>
dealii::Tensor<2, dim> Conditions<dim>::held(const Place<dim> &at) const
{
  dealii::Tensor<2, dim> P;
  for (const auto &support : input.model().supports)
    if (support.body == at.body && support.boundary == at.boundary)
      {
        Vector direction = support.component.direction(at.x, at.normal);
        direction -= P * direction;
        if (direction.norm() > 1e-3)
          P += outer_product(direction, direction) / direction.norm_square();
      }
  return P;
}

/// Return a vector field that has the symmetries of the concentrated forces of a boundary: each
/// force times a function of the distance from its place.
template <int dim>
static dealii::Tensor<1, dim> field_of(const std::vector<state::PlacedForce<dim>> &forces,
                                       const dealii::Point<dim>                   &x,
                                       const double                                length)
{
  dealii::Tensor<1, dim> sum;
  const auto             decay = [&](const dealii::Point<dim> &place) {
    return std::exp(-x.distance_square(place) / (length * length));
  };
  for (const auto &force : forces)
    sum += force.force * (force.along ? 1. + *force.along
                          : force.to  ? decay(force.from) + decay(*force.to)
                                      : decay(force.from));
  return sum;
}

/// Return the stiffness per area of the springs at a point, and a tensor field that has the
/// symmetries of the springs at points.
template <int dim>
static dealii::Tensor<2, dim>
stiffness_of_springs(const state::Model<dim> &model, const Place<dim> &at, const double length)
{
  dealii::Tensor<2, dim> sum;
  for (const auto &spring : model.springs)
    if (spring.body == at.body && spring.boundary == at.boundary)
      {
        const auto   q = spring.component.direction(at.x, at.normal);
        const double decay =
          spring.place ? std::exp(-at.x.distance_square(*spring.place) / (length * length)) : 1.;
        sum += decay * spring.stiffness(at.x) * outer_product(q, q);
      }
  return sum;
}

/// Prescribed components are those of supports. Their directions are at right angles or, at oblique
/// faces, differ in the same way at both points of a symmetry.
template <int dim>
void Conditions<dim>::add_loads(const Place<dim>  &at,
                                const unsigned int load_case,
                                PointData<dim>    &data) const
{
  Vector      prescribed, traction, concentrated;
  const auto &loads = input.model().load_cases[load_case].bodies[at.body];
  for (const auto &support : input.model().supports)
    if (support.body == at.body && support.boundary == at.boundary && support.values[load_case])
      prescribed += support.values[load_case](at.x) * support.component.direction(at.x, at.normal);
  elasticity::Resultant<dim> total;
  if (const auto found = loads.boundaries.find(at.boundary); found != loads.boundaries.end())
    {
      total    = found->second.resultant;
      traction = found->second.force_at(at.x, at.normal);
      concentrated =
        field_of<dim>(found->second.concentrated, dealii::Point<dim>(at.x), 0.3 * size());
    }
  dealii::Tensor<2, dim> moment; // maps v to m x v
  for (unsigned int j = 0; j < dim; ++j)
    {
      const Vector column =
        elasticity::turned(total.moment, Vector(dealii::Point<dim>::unit_vector(j)));
      for (unsigned int i = 0; i < dim; ++i)
        moment[i][j] = column[i];
    }
  data.push_back(tensor_datum(stiffness_of_springs(input.model(), at, 0.3 * size())));
  for (const auto &v : {prescribed, traction, concentrated, total.force})
    data.push_back(vector_datum(v));
  data.push_back(tensor_datum(moment));
}

/// Sums over the pairs of a face are compared, as a symmetry may exchange two pairs.
template <int dim>
void Conditions<dim>::add_contact(const Place<dim> &at, PointData<dim> &data) const
{
  const auto is_tied = [&](const auto &tie) {
    return contact::is_on(at, tie.slave) || contact::is_on(at, tie.master);
  };
  const auto  &ties    = input.model().ties;
  const double n_ties  = static_cast<double>(std::count_if(ties.begin(), ties.end(), is_tied));
  double       n_pairs = 0., n_obstacles = 0., gap = 0., distance = 0.;
  Vector       normal, motion;
  for (unsigned int p = 0; p < gaps.size(); ++p)
    {
      const auto &pair = input.model().pairs[p];
      if (!contact::is_on(at, pair.slave) && !contact::is_on(at, pair.master))
        continue;
      ++n_pairs;
      gap += gaps[p].value(at.x);
      if (!obstacles[p])
        continue;
      ++n_obstacles;
      for (unsigned int d = 0; d < pair.obstacle->displacement.size(); ++d)
        motion[d] += pair.obstacle->displacement[d];
      if (const auto found = obstacles[p]->distance(at.x))
        {
          // Rounding errors of a distance of zero are small relative to the size of the bodies.
          distance += size() + found->value;
          normal += found->gradient;
        }
    }
  for (const double s : {n_pairs, n_ties, n_obstacles, gap, distance})
    data.push_back(scalar_datum<dim>(s));
  for (const auto &v : {normal, motion})
    data.push_back(vector_datum(v));
}

template <int dim>
PointData<dim> Conditions<dim>::data(const Place<dim> &at) const
{
  const auto &cases = input.model().load_cases;
  if (at.material)
    {
      const auto &material = *at.material;
      const bool  is_B_bar =
        input.model().bodies[at.body].formulation == elasticity::Formulation::B_bar;
      PointData<dim> result;
      for (const double s : {1., material.youngs_modulus, material.poissons_ratio, material.density,
                             is_B_bar ? 1. : 0.})
        result.push_back(scalar_datum<dim>(s));
      for (const auto &load_case : cases)
        {
          const auto &loads = load_case.bodies[at.body];
          result.push_back(vector_datum(loads.force_per_volume(material, at.x)));
          result.push_back(scalar_datum<dim>(
            loads.temperature ? material.expansion * loads.temperature(at.x) : 0.));
        }
      return result;
    }
  PointData<dim> result = {scalar_datum<dim>(1.), vector_datum(at.normal), tensor_datum(held(at))};
  add_contact(at, result);
  for (unsigned int c = 0; c < cases.size(); ++c)
    add_loads(at, c, result);
  return result;
}

template <int dim>
bool Conditions<dim>::is_symmetry_support(const Place<dim> &at) const
{
  auto found = data(at);
  found[2] -= tensor_datum(dealii::Tensor<2, dim>(outer_product(at.normal, at.normal)));
  return std::all_of(found.begin() + 2, found.end(),
                     [](const auto &each) { return each.norm() < 1e-6; });
}

template class Comparison<2>;
template class Conditions<2>;
template class Comparison<3>;
template class Conditions<3>;
} // namespace snug::advice
