#ifndef snug_tests_qp_membranes_h
#define snug_tests_qp_membranes_h

#include "dense_problem.h"

#include <map>

/**
 * Two stacked membranes (Laplace, square Q1 cells, one unknown per node, the
 * deflection) torn into square subdomains that all float. The lower one is
 * clamped at its bottom; the upper one is pressed down and held by contact
 * with the lower one's top only. Rows as in Total FETI, orthonormal; the
 * preconditioner is B S B' with the Schur complements S.
 */
class Membranes
{
public:
  struct Shape
  {
    unsigned int columns   = 2; ///< subdomains per body and direction
    unsigned int rows      = 1;
    unsigned int cells     = 4;   ///< per subdomain and direction
    double       load      = 1.;  ///< on the whole top; < 0 pulls
    double       curvature = 0.5; ///< of the gap between the bodies
    double       shift     = 0.;  ///< of the lowest point of the gap
  };

  explicit Membranes(const Shape &shape)
    : shape(shape)
    , nx(shape.columns * shape.cells + 1)
    , ny(shape.rows * shape.cells + 1)
    , K(cell_matrix_sum(shape.cells + 1, shape.cells + 1))
  {
    make_subdomains();
    make_rows();
    make_data();
  }

  const DenseData &data() const { return dual; }

  /// Contact forces of the dual solution lambda, in the order of the nodes.
  dense::Matrix forces(const dense::Matrix &lambda) const
  {
    dense::Matrix p(nx);
    for (unsigned int c = 0; c < nx; ++c)
      p(c) = lambda(contact_row[c]) / contact_scale[c];
    return p;
  }

  /// Contact forces by an exact active set method on the untorn bodies,
  /// checked to satisfy all conditions.
  dense::Matrix untorn_forces() const
  {
    const unsigned int N = 2 * nx * ny;
    dense::Matrix      stiffness(N, N);
    const auto         body = cell_matrix_sum(nx, ny);
    for (unsigned int b = 0; b < 2; ++b)
      for (unsigned int i = 0; i < nx * ny; ++i)
        for (unsigned int j = 0; j < nx * ny; ++j)
          stiffness(b * nx * ny + i, b * nx * ny + j) = body(i, j);
    std::vector<bool> active(nx, true);
    for (unsigned int step = 0; step < 100; ++step)
      {
        dense::Matrix A(N + nx, N + nx), b(N + nx);
        for (unsigned int i = 0; i < N; ++i)
          {
            b(i) = node_load(i / (nx * ny), i % (nx * ny));
            for (unsigned int j = 0; j < N; ++j)
              A(i, j) = stiffness(i, j);
          }
        for (unsigned int i = 0; i < nx; ++i) // clamped: u = 0
          {
            for (unsigned int j = 0; j < N; ++j)
              A(i, j) = i == j;
            b(i) = 0.;
          }
        for (unsigned int c = 0; c < nx; ++c)
          if (active[c])
            {
              A(N + c, lower_top(c)) = A(lower_top(c), N + c) = 1.;
              A(N + c, nx * ny + c) = A(nx * ny + c, N + c) = -1.;
              b(N + c)                                      = gap(c);
            }
          else
            A(N + c, N + c) = 1.;
        const auto x       = dense::solve(A, b);
        bool       changed = false;
        for (unsigned int c = 0; c < nx; ++c)
          {
            const double open = gap(c) - x(lower_top(c)) + x(nx * ny + c);
            const bool   next = active[c] ? x(N + c) > 0. : open < -1e-13;
            changed           = changed || next != active[c];
            active[c]         = next;
          }
        if (!changed)
          {
            dense::Matrix p(nx);
            for (unsigned int c = 0; c < nx; ++c)
              p(c) = x(N + c);
            return p;
          }
      }
    ADD_FAILURE() << "the reference did not converge";
    return dense::Matrix(nx);
  }

  unsigned int n_contacts() const { return nx; }

private:
  using Copy = std::pair<unsigned int, unsigned int>; // subdomain, dof

  static dense::Matrix cell_matrix_sum(unsigned int nx, unsigned int ny)
  {
    const double  cell[4][4] = {{4, -1, -1, -2}, {-1, 4, -2, -1}, {-1, -2, 4, -1}, {-2, -1, -1, 4}};
    dense::Matrix K(nx * ny, nx * ny);
    for (unsigned int y = 0; y + 1 < ny; ++y)
      for (unsigned int x = 0; x + 1 < nx; ++x)
        {
          const unsigned int node[4] = {x + nx * y, x + 1 + nx * y, x + nx * (y + 1),
                                        x + 1 + nx * (y + 1)};
          for (unsigned int i = 0; i < 4; ++i)
            for (unsigned int j = 0; j < 4; ++j)
              K(node[i], node[j]) += cell[i][j] / 6.;
        }
    return K;
  }

  unsigned int lower_top(unsigned int c) const { return nx * (ny - 1) + c; }

  double gap(unsigned int c) const
  {
    const double x = double(c) / (nx - 1) - 0.5 - shape.shift;
    return shape.curvature * x * x;
  }

  /// Load in the direction of opening (upwards) at a node of a body.
  double node_load(unsigned int body, unsigned int node) const
  {
    if (body == 0 || node < nx * (ny - 1))
      return 0.;
    const unsigned int c = node - nx * (ny - 1);
    return -shape.load / (nx - 1) * (c == 0 || c == nx - 1 ? 0.5 : 1.);
  }

  void make_subdomains()
  {
    const unsigned int m = shape.cells;
    for (unsigned int body = 0; body < 2; ++body)
      for (unsigned int sy = 0; sy < shape.rows; ++sy)
        for (unsigned int sx = 0; sx < shape.columns; ++sx, ++n_subdomains)
          for (unsigned int y = 0; y <= m; ++y)
            for (unsigned int x = 0; x <= m; ++x)
              copies[body * nx * ny + sx * m + x + nx * (sy * m + y)].emplace_back(n_subdomains,
                                                                                   x + (m + 1) * y);
  }

  void make_rows()
  {
    for (const auto &[node, of_node] : copies)
      {
        const unsigned int m = of_node.size();
        if (node < nx) // clamped
          for (const Copy &copy : of_node)
            add_row({{copy, 1.}}, 0., false);
        else
          for (unsigned int i = 1; i < m; ++i)
            {
              std::map<Copy, double> row;
              const double           length = std::sqrt(i * (i + 1.));
              for (unsigned int j = 0; j < i; ++j)
                row[of_node[j]] = 1. / length;
              row[of_node[i]] = -(i / length);
              add_row(row, 0., false);
            }
        if (node >= nx * ny && node < nx * ny + nx)
          add_contact(node - nx * ny);
      }
  }

  void add_contact(unsigned int c)
  {
    const auto            &slave  = copies[nx * ny + c];
    const auto            &master = copies[lower_top(c)];
    const double           scale  = std::sqrt(1. / slave.size() + 1. / master.size());
    std::map<Copy, double> row;
    for (const Copy &copy : slave)
      row[copy] = -1. / slave.size() / scale;
    for (const Copy &copy : master)
      row[copy] = 1. / master.size() / scale;
    contact_row.push_back(B.size());
    contact_scale.push_back(scale);
    add_row(row, gap(c) / scale, true);
  }

  void add_row(const std::map<Copy, double> &row, double g, bool bounded)
  {
    B.push_back(row);
    gaps.push_back(g);
    dual.bounded.push_back(bounded);
  }

  /// S of the dofs that occur in B, zero elsewhere.
  dense::Matrix schur_complement(unsigned int s) const
  {
    const unsigned int n = K.n_rows();
    std::vector<bool>  boundary(n, false);
    for (const auto &row : B)
      for (const auto &entry : row)
        if (entry.first.first == s)
          boundary[entry.first.second] = true;
    std::vector<unsigned int> inner;
    for (unsigned int i = 0; i < n; ++i)
      if (!boundary[i])
        inner.push_back(i);
    dense::Matrix S(n, n), K_ii(inner.size(), inner.size()), K_ib(inner.size(), n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        S(i, j) = boundary[i] && boundary[j] ? K(i, j) : 0.;
    for (unsigned int i = 0; i < inner.size(); ++i)
      {
        for (unsigned int j = 0; j < inner.size(); ++j)
          K_ii(i, j) = K(inner[i], inner[j]);
        for (unsigned int j = 0; j < n; ++j)
          K_ib(i, j) = boundary[j] ? K(inner[i], j) : 0.;
      }
    if (!inner.empty())
      S.add(-1., dense::product(dense::transpose(K_ib), dense::solve(K_ii, K_ib)));
    return S;
  }

  void make_data()
  {
    const unsigned int n = B.size(), n_dofs = K.n_rows();
    const auto         K_plus = dense::pseudo_inverse(K);
    dual.F = dual.preconditioner = dense::Matrix(n, n);
    dual.G                       = dense::Matrix(n_subdomains, n);
    dual.d                       = dense::Matrix(n);
    dual.e                       = dense::Matrix(n_subdomains);
    for (unsigned int s = 0; s < n_subdomains; ++s)
      {
        dense::Matrix Bt(n_dofs, n), f(n_dofs), R(n_dofs);
        for (unsigned int i = 0; i < n; ++i)
          for (const auto &entry : B[i])
            if (entry.first.first == s)
              Bt(entry.first.second, i) = entry.second;
        for (const auto &[node, of_node] : copies)
          for (const Copy &copy : of_node)
            if (copy.first == s)
              f(copy.second) = node_load(node / (nx * ny), node % (nx * ny)) / of_node.size();
        for (unsigned int i = 0; i < n_dofs; ++i)
          R(i) = 1. / std::sqrt(n_dofs);
        const auto B_s = dense::transpose(Bt);
        dual.F.add(1., dense::product(B_s, dense::product(K_plus, Bt)));
        dual.preconditioner.add(1., dense::product(B_s, dense::product(schur_complement(s), Bt)));
        dual.d.add(1., dense::product(B_s, dense::product(K_plus, f)));
        const auto G_s = dense::product(dense::transpose(R), Bt);
        for (unsigned int i = 0; i < n; ++i)
          dual.G(s, i) = G_s(0, i);
        dual.e(s) = dense::product(dense::transpose(R), f)(0);
      }
    for (unsigned int i = 0; i < n; ++i)
      dual.d(i) -= gaps[i];
  }

  const Shape                               shape;
  const unsigned int                        nx, ny; // nodes of a body
  const dense::Matrix                       K;      // of a subdomain
  unsigned int                              n_subdomains = 0;
  std::map<unsigned int, std::vector<Copy>> copies; // of body * nx * ny + node
  std::vector<std::map<Copy, double>>       B;
  std::vector<double>                       gaps, contact_scale;
  std::vector<unsigned int>                 contact_row;
  DenseData                                 dual;
};

#endif
