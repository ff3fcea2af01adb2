#include <snug/elasticity/finite_difference.h>
#include <snug/sensitivity/data_derivatives.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug
{
  namespace sensitivity
  {
    namespace
    {
      /// What the derivatives of one subdomain are taken of and how.
      template <int dim>
      struct SubdomainDerivative
      {
        using Field = typename mesh::BodyMesh<dim>::Field;
        using Nodes = std::vector<dealii::Tensor<1, dim>>;

        const state::StateSolver<dim>  &solver;
        const state::ContactState<dim> &state;
        const GradientParameters       &parameters;
        unsigned int                    s;

        /// Nodes of a cell or face that move at all.
        static double
        largest(const Nodes &V)
        {
          double norm = 0.;
          for (const auto &v : V)
            norm = std::max(norm, v.norm());
          return norm;
        }

        /// f' along V for nodes X: exact() or the central difference of f.
        template <typename Exact>
        Nodes
        derivative(const elasticity::NodeFunction<dim> &f,
                   const Exact                         &exact,
                   const Nodes                         &X,
                   const Nodes                         &V) const
        {
          if (parameters.derivatives == "exact")
            {
              Nodes r;
              exact(r);
              return r;
            }
          const double size = (X.back() - X.front()).norm();
          return elasticity::central_difference<dim>(
            f, X, V, parameters.semi_analytic_step * size / largest(V));
        }

        void
        add_cells(const Field &velocity, double *ft) const;
        void
        add_faces(const Field &velocity, double *ft) const;
      };

      template <int dim>
      void
      SubdomainDerivative<dim>::add_cells(const Field &velocity,
                                          double      *ft) const
      {
        const auto &assembler = *solver.assemblers()[s];
        const auto &element   = assembler.element();
        const auto &b         = assembler.body_model().body_force;
        for (unsigned int i = 0; i < assembler.cells().size(); ++i)
          {
            const Nodes V = assembler.cell_field(i, velocity);
            if (largest(V) == 0.)
              continue;
            const auto &material = assembler.material(i);
            const Nodes X        = assembler.cell_field(i, state.positions);
            const Nodes u = assembler.cell_values(i, state.u[s].column(0));
            const Nodes r = derivative(
              [&](const Nodes &x, Nodes &f) {
                element.internal_force(x, material, u, f);
              },
              [&](Nodes &f) {
                element.internal_force_derivative(X, V, material, u, f);
              },
              X,
              V);
            assembler.add_cell_vector(i, -1., r, ft);
            if (b.norm() == 0.)
              continue;
            const Nodes load = derivative(
              [&](const Nodes &x, Nodes &f) { element.body_force(x, b, f); },
              [&](Nodes &f) { element.body_force_derivative(X, V, b, f); },
              X,
              V);
            assembler.add_cell_vector(i, 1., load, ft);
          }
      }

      template <int dim>
      void
      SubdomainDerivative<dim>::add_faces(const Field &velocity,
                                          double      *ft) const
      {
        const auto &assembler = *solver.assemblers()[s];
        const auto &face_load = solver.face_load();
        for (unsigned int i = 0; i < assembler.loaded_faces().size(); ++i)
          {
            const Nodes V = assembler.face_field(i, velocity);
            if (largest(V) == 0.)
              continue;
            const Nodes X    = assembler.face_field(i, state.positions);
            const auto &load = assembler.face_model(i);
            const Nodes r    = derivative(
              [&](const Nodes &x, Nodes &f) {
                face_load.force(x, load.pressure, load.traction, f);
              },
              [&](Nodes &f) {
                face_load.force_derivative(
                  X, V, load.pressure, load.traction, f);
              },
              X,
              V);
            assembler.add_face_vector(i, 1., r, ft);
          }
      }

      /// (forward - backward) / (2 step) of all numbers.
      template <int dim>
      state::RowCoefficients<dim>
      central_difference(const state::RowCoefficients<dim> &forward,
                         const state::RowCoefficients<dim> &backward,
                         double                             step)
      {
        auto       result   = forward;
        const auto subtract = [step](auto &value, const auto &other) {
          value = (value - other) / (2 * step);
        };
        for (unsigned int i = 0; i < result.contact.size(); ++i)
          {
            auto       &row   = result.contact[i];
            const auto &other = backward.contact[i];
            for (unsigned int k = 0; k < row.coefficients.size(); ++k)
              subtract(row.coefficients[k].second,
                       other.coefficients[k].second);
            subtract(row.gap, other.gap);
            subtract(row.normal, other.normal);
          }
        for (unsigned int h = 0; h < result.held.size(); ++h)
          for (unsigned int k = 0; k < result.held[h].directions.size(); ++k)
            {
              subtract(result.held[h].directions[k],
                       backward.held[h].directions[k]);
              for (unsigned int c = 0; c < result.held[h].values[k].size(); ++c)
                subtract(result.held[h].values[k][c],
                         backward.held[h].values[k][c]);
            }
        return result;
      }

      /// Derivatives of what the rows of B are made of along a velocity.
      template <int dim>
      state::RowCoefficients<dim>
      row_derivatives(const state::StateSolver<dim>             &solver,
                      const typename mesh::BodyMesh<dim>::Field &X,
                      const typename mesh::BodyMesh<dim>::Field &V,
                      const GradientParameters                  &parameters)
      {
        if (parameters.derivatives == "exact")
          return solver.row_derivatives(X, V);
        double size = 0., speed = 0.;
        for (const auto &face : solver.mesh().boundary_faces())
          for (const unsigned int node : face.nodes)
            {
              size  = std::max(size, (X[node] - X[face.nodes[0]]).norm());
              speed = std::max(speed, V[node].norm());
            }
        const MPI_Comm comm = solver.context().communicator();
        size                = dealii::Utilities::MPI::max(size, comm);
        speed               = dealii::Utilities::MPI::max(speed, comm);
        const double step =
          parameters.semi_analytic_step * size / (speed > 0. ? speed : 1.);
        auto forward = X, backward = X;
        for (unsigned int a = 0; a < X.size(); ++a)
          {
            forward[a] += step * V[a];
            backward[a] -= step * V[a];
          }
        return central_difference(solver.rows(forward),
                                  solver.rows(backward),
                                  step);
      }

      /// ft -= B'^T lambda and B' u into the local rows, column j.
      void
      add_row_derivatives(const std::vector<feti::BEntry> &B_derivative,
                          const qp::MultiVector           &lambda,
                          const qp::MultiVector           &u,
                          double                          *ft,
                          double                          *Bu)
      {
        for (const auto &entry : B_derivative)
          {
            ft[entry.dof] -= entry.value * lambda(entry.row);
            Bu[entry.row] += entry.value * u(entry.dof);
          }
      }
    } // namespace

    template <int dim>
    KktVectors
    data_derivatives(
      const state::StateSolver<dim>                          &solver,
      const state::ContactState<dim>                         &state,
      const std::vector<typename mesh::BodyMesh<dim>::Field> &velocities,
      const GradientParameters                               &parameters)
    {
      const unsigned int k      = velocities.size();
      const auto        &layout = solver.gluing().layout();
      const auto         lambda = layout.to_local(state.dual.lambda);
      const auto         rows   = solver.rows(state.positions);
      KktVectors         result;
      for (const auto &u : state.u)
        result.primal.emplace_back(u.n_rows(), k);
      qp::MultiVector Bu(layout.n_local(), k);
      result.dual = qp::MultiVector(layout.n_owned(), k);
      std::vector<feti::BEntry> B_derivative;
      for (unsigned int j = 0; j < k; ++j)
        {
          const auto derivative = row_derivatives<dim>(solver,
                                                       state.positions,
                                                       velocities[j],
                                                       parameters);
          const auto g =
            solver.gluing().right_hand_side_derivative(rows, derivative, 0);
          std::copy_n(g.column(0), g.n_rows(), result.dual.column(j));
          for (unsigned int s = 0; s < state.u.size(); ++s)
            {
              const SubdomainDerivative<dim> subdomain{solver,
                                                       state,
                                                       parameters,
                                                       s};
              double                        *ft = result.primal[s].column(j);
              subdomain.add_cells(velocities[j], ft);
              subdomain.add_faces(velocities[j], ft);
              solver.gluing().fill_B_derivative(s,
                                                rows,
                                                derivative,
                                                B_derivative);
              add_row_derivatives(
                B_derivative, lambda, state.u[s], ft, Bu.column(j));
            }
        }
      result.dual.add(-1., layout.to_owned(Bu));
      return result;
    }

#define SNUG_INSTANTIATE(dim)                        \
  template KktVectors data_derivatives(              \
    const state::StateSolver<dim> &,                 \
    const state::ContactState<dim> &,                \
    const std::vector<mesh::BodyMesh<dim>::Field> &, \
    const GradientParameters &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace sensitivity
} // namespace snug
