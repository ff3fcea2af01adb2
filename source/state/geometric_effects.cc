#include <snug/base/narrow.h>
#include <snug/elasticity/cell_point.h>
#include <snug/qp/direction_basis.h>
#include <snug/state/body_boxes.h>
#include <snug/state/geometric_effects.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::state {
namespace {
/// Part of the energy of all bodies below which the energy of a body does not count.
const double least_part = 1e-3;

/// Energy of stresses that are round-off, as a part of the energy that the displacement gradients
/// would have as strains. A body that expands freely has no other stresses.
const double least_strained = 1e-14;

/// Rigid motions of a body up to this part of the largest one are held by rounding errors alone.
const double held_cut = 1e-10;

/// Integrals over a body with Young's modulus E. With a constant matrix W, the integral of sigma :
/// (G - W)'(G - W) is GGS - 2 W : GS + W : (W S).
struct Integrals
{
  double               energy = 0., volume = 0.; ///< int sigma : C^-1 sigma, int 1
  double               EGG = 0.;                 ///< int E G : G
  double               GGS = 0.;                 ///< int sigma : G'G
  dealii::Tensor<2, 3> GS, S, G;                 ///< int G sigma, int sigma, int G

  /// Call visit(number) for all numbers.
  template <typename Visit>
  void for_each(const Visit &visit)
  {
    for (double *number : {&energy, &volume, &EGG, &GGS})
      visit(*number);
    for (auto *matrix : {&GS, &S, &G})
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          visit((*matrix)[i][j]);
  }
};

/// Return sigma : C^-1 sigma, which is sigma : eps without the thermal strain. The integral of
/// sigma : eps is zero for stresses that heat alone causes.
double elastic_density(const elasticity::Material &material, const dealii::Tensor<2, 3> &sigma)
{
  const double nu = material.poissons_ratio, sum = trace(sigma);
  return ((1. + nu) * sigma.norm_square() - nu * sum * sum) / material.youngs_modulus;
}

template <int dim>
std::vector<Integrals> integrals(const StateSolver<dim> &solver, const ContactState<dim> &state)
{
  const auto            &idealization = solver.mesh().idealization();
  std::vector<Integrals> result(solver.model().bodies.size());
  for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
    {
      const auto &assembler = *solver.assemblers()[s];
      if (assembler.is_point())
        continue;
      Integrals &of_body = result[solver.tearing().subdomains[s].body];
      for (unsigned int i = 0; i < assembler.n_pieces(); ++i)
        {
          const auto  X        = assembler.piece_field(i, state.positions);
          const auto  u        = assembler.piece_values(i, state.u[s].column(0));
          const auto &shapes   = assembler.piece_points(i);
          const auto &material = assembler.material(assembler.cell_of_piece(i));
          const auto  stresses =
            assembler.element().stresses(X, material, u, shapes,
                                         assembler.piece_strain(i, state.load_case));
          for (unsigned int q = 0; q < shapes.size(); ++q)
            {
              const elasticity::CellPoint<dim> point(shapes[q], X, idealization);
              const auto                       G     = point.gradient(u);
              const dealii::Tensor<2, 3>       sigma = stresses[q], GS = G * sigma;
              of_body.energy += elastic_density(material, sigma) * point.dV;
              of_body.volume += point.dV;
              of_body.EGG += material.youngs_modulus * G.norm_square() * point.dV;
              of_body.GGS += scalar_product(G, GS) * point.dV;
              of_body.GS += GS * point.dV;
              of_body.S += sigma * point.dV;
              of_body.G += G * point.dV;
            }
        }
    }
  std::vector<double> numbers;
  for (auto &of_body : result)
    of_body.for_each([&](double &number) { numbers.push_back(number); });
  dealii::Utilities::MPI::sum(numbers, solver.context().communicator(), numbers);
  auto next = numbers.begin();
  for (auto &of_body : result)
    of_body.for_each([&](double &number) { number = *next++; });
  return result;
}

/// Return, for each body, the axes of the rotations (2D: the last axis alone) that its supports
/// leave free, orthonormal. Collective.
template <int dim>
std::vector<std::vector<dealii::Tensor<1, 3>>> free_rotations(const StateSolver<dim>  &solver,
                                                              const ContactState<dim> &state)
{
  const unsigned int n_bodies = narrow<unsigned int>(solver.model().bodies.size()), n = 6;
  const auto        &mesh   = solver.mesh();
  const auto         frames = solver.held().frames(state.positions);
  const auto         boxes  = body_boxes(mesh);
  // The sums of r r' over all held directions q at x, where r . (t, w) = q . (t + w x x), with x
  // from the centre of the body, over its size.
  std::vector<double> sums(std::size_t(n_bodies) * n * n, 0.);
  const unsigned int  rank = solver.context().rank();
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
      const unsigned int h = solver.held().find(mesh.global_node(node));
      if (h == solver.held().n_nodes() || mesh.owner(node) != rank)
        continue;
      const auto &box   = boxes[mesh.body_of_node(node)];
      const auto  place = (state.positions[node] - box.centre) / box.length;
      for (const auto &direction : frames.directions(h))
        {
          dealii::Tensor<1, 3> q, x;
          for (int d = 0; d < dim; ++d)
            {
              q[d] = direction[d];
              x[d] = place[d];
            }
          const auto   moment = cross_product_3d(x, q);
          const double r[n]   = {q[0], q[1], q[2], moment[0], moment[1], moment[2]};
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              sums[(std::size_t(mesh.body_of_node(node)) * n + i) * n + j] += r[i] * r[j];
        }
    }
  dealii::Utilities::MPI::sum(sums, mesh.communicator(), sums);
  std::vector<std::vector<dealii::Tensor<1, 3>>> result(n_bodies);
  for (unsigned int body = 0; body < n_bodies; ++body)
    {
      qp::MultiVector M(n, n);
      double          largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            M(i, j) = sums[(std::size_t(body) * n + i) * n + j];
            // In the plane only rotations about the last axis are motions.
            if (dim == 2 && i == j && (i == 3 || i == 4))
              M(i, i) += 1.;
            largest = std::max(largest, std::abs(M(i, j)));
          }
      const auto free = qp::null_space(M, held_cut * largest);
      for (unsigned int k = 0; k < free.n_columns(); ++k)
        {
          dealii::Tensor<1, 3> axis({free(3, k), free(4, k), free(5, k)});
          for (const auto &other : result[body])
            axis -= (axis * other) * other;
          if (axis.norm() > std::sqrt(held_cut))
            result[body].push_back(axis / axis.norm());
        }
    }
  return result;
}
} // namespace

template <int dim>
std::vector<GeometricEffect> geometric_effects(const StateSolver<dim>  &solver,
                                               const ContactState<dim> &state)
{
  const auto of_bodies = integrals(solver, state);
  // In axisymmetric sections, rotations are no rigid motions.
  const auto rotations = solver.mesh().idealization().is_axisymmetric()
                           ? std::vector<std::vector<dealii::Tensor<1, 3>>>(of_bodies.size())
                           : free_rotations(solver, state);
  double     energy    = 0.;
  for (const auto &of_body : of_bodies)
    energy += std::abs(of_body.energy);
  std::vector<GeometricEffect> result;
  for (unsigned int body = 0; body < of_bodies.size(); ++body)
    {
      const auto          &of   = of_bodies[body];
      const auto           mean = of.G / of.volume;
      dealii::Tensor<1, 3> spin(
        {mean[2][1] - mean[1][2], mean[0][2] - mean[2][0], mean[1][0] - mean[0][1]}),
        w;
      for (const auto &axis : rotations[body])
        w += 0.5 * (spin * axis) * axis;
      const dealii::Tensor<2, 3> W({{0., -w[2], w[1]}, {w[2], 0., -w[0]}, {-w[1], w[0], 0.}});
      const double               of_second_order =
        of.GGS - 2. * scalar_product(W, of.GS) + scalar_product(W, dealii::Tensor<2, 3>(W * of.S));
      const double of_first_order =
        std::max({std::abs(of.energy), least_part * energy, least_strained * of.EGG});
      result.push_back({solver.model().body_names[body],
                        of_first_order > 0. ? of_second_order / of_first_order : 0., w.norm()});
    }
  return result;
}

template std::vector<GeometricEffect> geometric_effects(const StateSolver<2> &,
                                                        const ContactState<2> &);
template std::vector<GeometricEffect> geometric_effects(const StateSolver<3> &,
                                                        const ContactState<3> &);
} // namespace snug::state
