#ifndef snug_tests_unit_state_untorn_solver_h
#define snug_tests_unit_state_untorn_solver_h

#include <deal.II/lac/sparse_direct.h>

#include <unit/state/untorn_body.h>

namespace snug::test {
/**
 * The contact problem of a test scene without tearing, duality or any of
 * Snug's code: deal.II's constraints and mapping, contact rows of its own,
 * the KKT matrix by UMFPACK, a primal-dual active set around it.
 */
template <int dim>
class Untorn
{
public:
  using Vector = dealii::Vector<double>;
  using Tensor = dealii::Tensor<1, dim>;

  struct Contact
  {
    unsigned int slave; ///< node of body 0
    double       gap;   ///< undeformed
    /// (dof of both bodies, coefficient), constraints resolved
    std::vector<std::pair<unsigned int, double>> row;
    double                                       force = 0., pressure = 0.;
  };

  explicit Untorn(const TestScene<dim> &scene);

  /// @throws dealii::ExceptionBase if the active set does not settle.
  void solve();

  /// Displacement at the node of @p body whose reference position is
  /// @p x; throws std::out_of_range if there is none.
  Tensor displacement(unsigned int body, const Tensor &x) const
  {
    return bodies[body]->at_node(u[body], node_at[body].at(node_key<dim>(x)));
  }

  std::map<unsigned int, Contact>                            contacts; ///< by slave node
  std::vector<std::map<std::array<long, dim>, unsigned int>> node_at;
  double                                                     energy = 0., compliance = 0.;

private:
  using Body        = UntornBody<dim>;
  using Face        = typename Body::Face;
  using Coordinates = std::array<double, 2>;

  std::vector<std::unique_ptr<Body>> bodies;
  std::vector<Vector>                u;

  void pair_contacts();
  void
  add_coefficient(const Tensor &c, unsigned int body, unsigned int node, Contact &contact) const;
  dealii::DynamicSparsityPattern
       pattern_of(const std::vector<dealii::SparseMatrix<double>> &K) const;
  void solve_active_set(const std::vector<dealii::SparseMatrix<double>> &K,
                        const std::vector<Vector>                       &f,
                        std::vector<bool>                               &active);

  std::vector<double> shape(const Coordinates &xi, int derivative) const;
  Tensor              on_face(const Face &face, const Coordinates &xi, int derivative) const;
  std::pair<double, Coordinates> closest(const Face &face, const Tensor &p) const;
  Tensor      area_vector(const Face &face, const Vector &x, unsigned int k) const;
  Coordinates foot(const Face                           &face,
                   const Coordinates                    &paired,
                   const Tensor                         &p,
                   const std::map<unsigned int, Tensor> &normals) const;
};

template <int dim>
Untorn<dim>::Untorn(const TestScene<dim> &scene) : node_at(2)
{
  for (unsigned int b = 0; b < 2; ++b)
    {
      bodies.push_back(std::make_unique<Body>(scene, b));
      for (unsigned int node = 0; node < bodies[b]->flat.size(); ++node)
        node_at[b][node_key<dim>(bodies[b]->at_node(bodies[b]->reference, node))] = node;
    }
  pair_contacts();
}

/// Lagrange functions at xi, or their derivatives along one coordinate.
template <int dim>
std::vector<double> Untorn<dim>::shape(const Coordinates &xi, int derivative) const
{
  const auto line = [&](double s, bool differentiate) {
    if (bodies[1]->fe.degree == 1)
      return differentiate ? std::vector<double>{-1., 1.} : std::vector<double>{1. - s, s};
    return differentiate
             ? std::vector<double>{4. * s - 3., 4. - 8. * s, 4. * s - 1.}
             : std::vector<double>{(1. - s) * (1. - 2. * s), 4. * s * (1. - s), s * (2. * s - 1.)};
  };
  const auto a = line(xi[0], derivative == 0);
  if (dim == 2)
    return a;
  const auto          b = line(xi[1], derivative == 1);
  std::vector<double> product;
  for (const double bj : b)
    for (const double ai : a)
      product.push_back(ai * bj);
  return product;
}

/// Point of a master face in the reference, or a tangent.
template <int dim>
typename Untorn<dim>::Tensor
Untorn<dim>::on_face(const Face &face, const Coordinates &xi, int derivative) const
{
  const auto N = shape(xi, derivative);
  Tensor     x;
  for (unsigned int k = 0; k < N.size(); ++k)
    x += N[k] * bodies[1]->at_node(bodies[1]->reference, face.nodes[k]);
  return x;
}

/// Closest point by ever finer grids, then Newton on J'J along the
/// coordinates inside (exact in the limit for flat faces; the curved ones
/// of Q2 converge because the grid starts it well).
template <int dim>
std::pair<double, typename Untorn<dim>::Coordinates> Untorn<dim>::closest(const Face   &face,
                                                                          const Tensor &p) const
{
  const unsigned int n = 8;
  Coordinates        best{{0.5, 0.5}};
  for (double width = 0.5; width > 1e-7; width *= 0.3)
    {
      const Coordinates centre = best;
      double            least  = 1e300;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; j <= (dim == 3 ? n : 0); ++j)
          {
            Coordinates xi;
            xi[0] = centre[0] + width * (2. * i / n - 1.);
            xi[1] = centre[1] + width * (2. * j / n - 1.);
            for (double &x : xi)
              x = std::min(1., std::max(0., x));
            const double d = (on_face(face, xi, -1) - p).norm();
            if (d < least)
              {
                least = d;
                best  = xi;
              }
          }
    }
  for (unsigned int step = 0; step < 200; ++step)
    for (int d = 0; d < dim - 1; ++d)
      {
        const Tensor t = on_face(face, best, d);
        best[d] -= (t * (on_face(face, best, -1) - p)) / (t * t);
        best[d] = std::min(1., std::max(0., best[d]));
      }
  return {(on_face(face, best, -1) - p).norm(), best};
}

/// Upward area vector t_x x t_y at node @p k of a master face.
template <int dim>
typename Untorn<dim>::Tensor
Untorn<dim>::area_vector(const Face &face, const Vector &x, unsigned int k) const
{
  const unsigned int degree = bodies[1]->fe.degree, n = degree + 1;
  const Coordinates  xi{{double(k % n) / degree, double(k / n) / degree}};
  Tensor             t[2];
  for (int d = 0; d < dim - 1; ++d)
    {
      const auto dN = shape(xi, d);
      for (unsigned int j = 0; j < dN.size(); ++j)
        t[d] += dN[j] * bodies[1]->at_node(x, face.nodes[j]);
    }
  Tensor a;
  if (dim == 2)
    {
      a[0] = -t[0][1];
      a[1] = t[0][0];
    }
  else
    for (unsigned int c = 0; c < dim; ++c)
      a[c] = t[0][(c + 1) % dim] * t[1][(c + 2) % dim] - t[0][(c + 2) % dim] * t[1][(c + 1) % dim];
  return a;
}

template <int dim>
void Untorn<dim>::add_coefficient(const Tensor &c,
                                  unsigned int  body,
                                  unsigned int  node,
                                  Contact      &contact) const
{
  const unsigned int offset = body == 0 ? 0 : bodies[0]->n_dofs();
  for (unsigned int d = 0; d < dim; ++d)
    {
      const unsigned int dof         = bodies[body]->node_dofs[node][d];
      const auto        &constraints = bodies[body]->constraints;
      if (!constraints.is_constrained(dof))
        contact.row.emplace_back(offset + dof, c[d]);
      else
        for (const auto &entry : *constraints.get_constraint_entries(dof))
          contact.row.emplace_back(offset + entry.first, c[d] * entry.second);
    }
}

/// Where the ray to @p p begins on a master face that is flat in the reference and along the axes:
/// xi by a fixed point, t from the heights. Coordinates on nodes stay.
template <int dim>
typename Untorn<dim>::Coordinates
Untorn<dim>::foot(const Face                           &face,
                  const Coordinates                    &paired,
                  const Tensor                         &p,
                  const std::map<unsigned int, Tensor> &normals) const
{
  const Tensor extent = on_face(face, {{1., 1.}}, -1) - on_face(face, {{0., 0.}}, -1);
  const double degree = bodies[1]->fe.degree;
  Coordinates  xi     = paired;
  for (unsigned int iteration = 0; iteration < 100; ++iteration)
    {
      const auto N   = shape(xi, -1);
      Tensor     off = -p, v;
      for (unsigned int k = 0; k < N.size(); ++k)
        {
          const Tensor &a = normals.at(face.nodes[k]);
          off += N[k] * bodies[1]->at_node(bodies[1]->positions, face.nodes[k]);
          v += N[k] * a / a.norm();
        }
      off -= off[dim - 1] / v[dim - 1] * v;
      for (unsigned int d = 0; d < dim - 1; ++d)
        if (std::abs(paired[d] * degree - std::round(paired[d] * degree)) > 1e-6)
          xi[d] -= off[d] / extent[d];
    }
  return xi;
}

template <int dim>
void Untorn<dim>::pair_contacts()
{
  const auto                     masters = bodies[1]->faces(face_index(dim - 1, 1));
  std::map<unsigned int, Tensor> normals;
  for (const Face &face : masters)
    for (unsigned int k = 0; k < face.nodes.size(); ++k)
      normals[face.nodes[k]] += area_vector(face, bodies[1]->positions, k);
  for (const Face &slave_face : bodies[0]->faces(face_index(dim - 1, 0)))
    for (const unsigned int slave : slave_face.nodes)
      {
        if (contacts.count(slave) == 1 ||
            bodies[0]->hanging.is_constrained(bodies[0]->node_dofs[slave][0]))
          continue;
        const Tensor p     = bodies[0]->at_node(bodies[0]->reference, slave);
        double       least = 1e300;
        Face         face;
        Coordinates  paired{};
        for (const Face &master : masters)
          {
            const auto found = closest(master, p);
            if (found.first < least - 1e-13)
              {
                least  = found.first;
                face   = master;
                paired = found.second;
              }
          }
        const auto weights =
          shape(foot(face, paired, bodies[0]->at_node(bodies[0]->positions, slave), normals), -1);
        Tensor n, x = -bodies[0]->at_node(bodies[0]->positions, slave);
        for (unsigned int k = 0; k < weights.size(); ++k)
          {
            const Tensor &a = normals[face.nodes[k]];
            n -= weights[k] * a / a.norm();
            x += weights[k] * bodies[1]->at_node(bodies[1]->positions, face.nodes[k]);
          }
        n /= n.norm();
        Contact &contact = contacts[slave];
        contact.slave    = slave;
        contact.gap      = n * x;
        add_coefficient(n, 0, slave, contact);
        for (unsigned int k = 0; k < weights.size(); ++k)
          add_coefficient(-weights[k] * n, 1, face.nodes[k], contact);
      }
}

/// Return the pattern of K, followed by the rows of all contacts, active or not.
template <int dim>
dealii::DynamicSparsityPattern
Untorn<dim>::pattern_of(const std::vector<dealii::SparseMatrix<double>> &K) const
{
  const unsigned int             n_0 = bodies[0]->n_dofs();
  const unsigned int             n   = n_0 + bodies[1]->n_dofs();
  dealii::DynamicSparsityPattern pattern(n + contacts.size());
  for (unsigned int b = 0; b < 2; ++b)
    for (const auto &entry : K[b])
      pattern.add(b * n_0 + entry.row(), b * n_0 + entry.column());
  unsigned int i = n;
  for (const auto &entry : contacts)
    {
      pattern.add(i, i);
      for (const auto &c : entry.second.row)
        {
          pattern.add(i, c.first);
          pattern.add(c.first, i);
        }
      ++i;
    }
  return pattern;
}

template <int dim>
void Untorn<dim>::solve_active_set(const std::vector<dealii::SparseMatrix<double>> &K,
                                   const std::vector<Vector>                       &f,
                                   std::vector<bool>                               &active)
{
  const unsigned int      n_0 = bodies[0]->n_dofs();
  const unsigned int      n   = n_0 + bodies[1]->n_dofs();
  const unsigned int      m   = contacts.size();
  dealii::SparsityPattern kkt_pattern;
  kkt_pattern.copy_from(pattern_of(K));
  dealii::SparseMatrix<double> kkt(kkt_pattern);
  Vector                       x(n + m);
  for (unsigned int b = 0; b < 2; ++b)
    {
      for (const auto &entry : K[b])
        kkt.add(b * n_0 + entry.row(), b * n_0 + entry.column(), entry.value());
      for (unsigned int j = 0; j < f[b].size(); ++j)
        x(b * n_0 + j) = f[b](j);
    }
  unsigned int i = n;
  for (const auto &entry : contacts)
    {
      if (active[i - n])
        {
          x(i) = entry.second.gap;
          for (const auto &c : entry.second.row)
            {
              kkt.add(i, c.first, c.second);
              kkt.add(c.first, i, c.second);
            }
        }
      else
        kkt.add(i, i, 1.);
      ++i;
    }
  dealii::SparseDirectUMFPACK direct;
  direct.solve(kkt, x);
  u.assign(2, Vector());
  for (unsigned int b = 0; b < 2; ++b)
    {
      u[b].reinit(f[b].size());
      for (unsigned int j = 0; j < f[b].size(); ++j)
        u[b](j) = x(b * n_0 + j);
    }
  i = n;
  for (auto &entry : contacts)
    {
      entry.second.force = x(i);
      double overlap     = -entry.second.gap;
      for (const auto &c : entry.second.row)
        overlap += c.second * x(c.first);
      // any positive stiffness would do
      const double stiffness = 1000.;
      active[i - n]          = x(i) + stiffness * overlap > 0.;
      ++i;
    }
}

template <int dim>
void Untorn<dim>::solve()
{
  std::vector<dealii::SparseMatrix<double>> K(2);
  std::vector<Vector>                       f(2);
  for (unsigned int b = 0; b < 2; ++b)
    bodies[b]->assemble(K[b], f[b]);
  std::vector<bool> active(contacts.size(), true), before;
  for (unsigned int step = 0; before != active; ++step)
    {
      AssertThrow(step < 40, dealii::ExcMessage("active set cycles"));
      before = active;
      solve_active_set(K, f, active);
    }
  const auto areas = bodies[0]->areas(face_index(dim - 1, 0));
  for (auto &entry : contacts)
    entry.second.pressure = entry.second.force / areas[entry.second.slave];
  for (unsigned int b = 0; b < 2; ++b)
    {
      energy += K[b].matrix_norm_square(u[b]) / 2 - f[b] * u[b];
      compliance += f[b] * u[b];
      bodies[b]->constraints.distribute(u[b]);
    }
}
} // namespace snug::test

#endif
