#include <snug/elasticity/element.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

namespace snug
{
  namespace elasticity
  {
    namespace
    {
      /**
       * K of one element with all loop bounds known to the compiler.
       *
       * The material is constant in the cell, so that the quadrature reduces
       * to one symmetric product
       *   H_(ca)(db) = sum_q dV_q g_a,c g_b,d
       * after which
       *   K_(ac)(bd) = lambda H_(ca)(db) + mu H_(da)(cb)
       *                + mu delta_cd sum_e H_(ea)(eb).
       * Index (ca) = c * n_padded + a; n_padded is a multiple of the tile size,
       * so H is computed in square tiles that stay in registers.
       */
      template <int dim, int degree>
      class StiffnessKernel
      {
      public:
        static constexpr int tile     = 4;
        static constexpr int n        = dealii::Utilities::pow(degree + 1, dim);
        static constexpr int n_gauss  = n;
        static constexpr int n_padded = (n + tile - 1) / tile * tile;
        static constexpr int n_rows   = dim * n_padded;

        /// @p reference: [point][d][a] as in Element.
        void
        compute_gradients(const std::vector<dealii::Tensor<1, dim>> &X,
                          const std::vector<LagrangePoint<dim>>     &gauss,
                          const double                              *reference);

        /// H on and above its diagonal tiles.
        void
        compute_products();

        void
        combine(const double lambda, const double mu, double *K) const;

      private:
        double positions[dim][n_padded];
        double gradients[n_gauss][n_rows];
        double weighted[n_gauss][n_rows]; ///< dV times gradients
        double products[n_rows][n_rows];  ///< H

        dealii::Tensor<2, dim>
        jacobian(const double *reference) const;
      };

      template <int dim, int degree>
      dealii::Tensor<2, dim>
      StiffnessKernel<dim, degree>::jacobian(const double *reference) const
      {
        dealii::Tensor<2, dim> J;
        for (int c = 0; c < dim; ++c)
          for (int d = 0; d < dim; ++d)
            {
              double sums[tile] = {};
              for (int a = 0; a < n_padded; a += tile)
                for (int i = 0; i < tile; ++i)
                  sums[i] +=
                    positions[c][a + i] * reference[d * n_padded + a + i];
              J[c][d] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
            }
        return J;
      }

      template <int dim, int degree>
      void
      StiffnessKernel<dim, degree>::compute_gradients(
        const std::vector<dealii::Tensor<1, dim>> &X,
        const std::vector<LagrangePoint<dim>>     &gauss,
        const double                              *reference)
      {
        for (int c = 0; c < dim; ++c)
          for (int a = 0; a < n_padded; ++a)
            positions[c][a] = a < n ? X[a][c] : 0.;

        for (int q = 0; q < n_gauss; ++q, reference += n_rows)
          {
            const dealii::Tensor<2, dim> J       = jacobian(reference);
            const dealii::Tensor<2, dim> inverse = invert(J);
            const double                 dV = gauss[q].weight * determinant(J);
            for (int c = 0; c < dim; ++c)
              for (int a = 0; a < n_padded; ++a)
                {
                  double g = 0.;
                  for (int d = 0; d < dim; ++d)
                    g += inverse[d][c] * reference[d * n_padded + a];
                  gradients[q][c * n_padded + a] = g;
                  weighted[q][c * n_padded + a]  = dV * g;
                }
          }
      }

      template <int dim, int degree>
      void
      StiffnessKernel<dim, degree>::compute_products()
      {
        for (int I = 0; I < n_rows; I += tile)
          for (int J = I; J < n_rows; J += tile)
            {
              double H[tile][tile] = {};
              for (int q = 0; q < n_gauss; ++q)
                for (int i = 0; i < tile; ++i)
                  for (int j = 0; j < tile; ++j)
                    H[i][j] += weighted[q][I + i] * gradients[q][J + j];
              for (int i = 0; i < tile; ++i)
                for (int j = 0; j < tile; ++j)
                  products[I + i][J + j] = H[i][j];
            }
      }

      template <int dim, int degree>
      void
      StiffnessKernel<dim, degree>::combine(const double lambda,
                                            const double mu,
                                            double      *K) const
      {
        constexpr int N   = n * dim;
        const auto    set = [K](const int row, const int column, double value) {
          K[row * N + column] = value;
          K[column * N + row] = value;
        };
        for (int a = 0; a < n; ++a)
          for (int b = a; b < n; ++b)
            {
              double trace = 0.;
              for (int c = 0; c < dim; ++c)
                trace += products[c * n_padded + a][c * n_padded + b];
              for (int c = 0; c < dim; ++c)
                {
                  set(a * dim + c,
                      b * dim + c,
                      (lambda + mu) *
                          products[c * n_padded + a][c * n_padded + b] +
                        mu * trace);
                  for (int d = c + 1; d < dim; ++d)
                    {
                      const double H_cd =
                        products[c * n_padded + a][d * n_padded + b];
                      const double H_dc =
                        products[c * n_padded + b][d * n_padded + a];
                      set(a * dim + c, b * dim + d, lambda * H_cd + mu * H_dc);
                      set(a * dim + d, b * dim + c, lambda * H_dc + mu * H_cd);
                    }
                }
            }
      }

      template <int degree, int dim>
      void
      compute_stiffness(const std::vector<dealii::Tensor<1, dim>> &X,
                        const std::vector<LagrangePoint<dim>>     &gauss,
                        const std::vector<double>                 &reference,
                        const Material                            &material,
                        std::vector<double>                       &K)
      {
        using Kernel = StiffnessKernel<dim, degree>;
        AssertDimension(X.size(), Kernel::n);
        AssertDimension(reference.size(), Kernel::n_gauss * Kernel::n_rows);
        K.resize(Kernel::n * Kernel::n * dim * dim);

        Kernel kernel;
        kernel.compute_gradients(X, gauss, reference.data());
        kernel.compute_products();
        kernel.combine(material.lame_lambda(), material.lame_mu(), K.data());
      }
    } // namespace

    template <int dim>
    void
    Element<dim>::stiffness(const Nodes         &X,
                            const Material      &material,
                            std::vector<double> &K) const
    {
      if (degree == 1)
        compute_stiffness<1>(X, gauss, reference_gradients, material, K);
      else
        compute_stiffness<2>(X, gauss, reference_gradients, material, K);
    }

    template void
    Element<2>::stiffness(const Nodes &,
                          const Material &,
                          std::vector<double> &) const;
    template void
    Element<3>::stiffness(const Nodes &,
                          const Material &,
                          std::vector<double> &) const;
  } // namespace elasticity
} // namespace snug
