#include <snug/optimization/projected_gradient.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <limits>

namespace snug
{
  namespace optimization
  {
    namespace
    {
      using Rows = std::vector<std::vector<double>>;

      double
      dot(const std::vector<double> &a, const std::vector<double> &b)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < a.size(); ++i)
          sum += a[i] * b[i];
        return sum;
      }

      void
      add(std::vector<double> &a, double factor, const std::vector<double> &b)
      {
        for (unsigned int i = 0; i < a.size(); ++i)
          a[i] += factor * b[i];
      }

      std::vector<double>
      restricted(const std::vector<double> &v, const std::vector<bool> &used)
      {
        std::vector<double> result(v.size(), 0.);
        for (unsigned int i = 0; i < v.size(); ++i)
          if (used[i])
            result[i] = v[i];
        return result;
      }

      /**
       * An orthonormal basis q_k of the restricted rows and, with it, the
       * combinations of the full rows: t_k = sum_j T_kj A_j agrees with q_k on
       * the used entries. Dependent rows are left out; Gram-Schmidt twice.
       */
      void
      orthonormalize(const Rows              &A,
                     const std::vector<bool> &used,
                     Rows                    &q,
                     Rows                    &t)
      {
        for (const auto &row : A)
          {
            auto         v = restricted(row, used), full = row;
            const double size = std::sqrt(dot(v, v));
            for (unsigned int pass = 0; pass < 2; ++pass)
              for (unsigned int k = 0; k < q.size(); ++k)
                {
                  const double share = dot(v, q[k]);
                  add(v, -share, q[k]);
                  add(full, -share, t[k]);
                }
            const double rest = std::sqrt(dot(v, v));
            if (rest <= 1e-12 * size)
              continue;
            for (unsigned int i = 0; i < v.size(); ++i)
              {
                v[i] /= rest;
                full[i] /= rest;
              }
            q.push_back(v);
            t.push_back(full);
          }
      }

      /// g + A' mu with the mu that makes its used part smallest.
      std::vector<double>
      reduced_gradient(const std::vector<double> &g,
                       const Rows                &A,
                       const std::vector<bool>   &used)
      {
        Rows q, t;
        orthonormalize(A, used, q, t);
        auto r = g;
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (unsigned int k = 0; k < q.size(); ++k)
            add(r, -dot(r, q[k]), t[k]);
        return r;
      }

      /// Whether moving against @p r leaves the objective's descent possible.
      bool
      counts(const double r, const Place place)
      {
        switch (place)
          {
            case Place::inside:
              return true;
            case Place::at_lower:
              return r < 0.;
            case Place::at_upper:
              return r > 0.;
            case Place::fixed:
              return false;
          }
        return false;
      }
    } // namespace

    double
    projected_gradient_norm(const std::vector<double>              &g,
                            const std::vector<std::vector<double>> &A,
                            const std::vector<Place>               &places)
    {
      AssertDimension(g.size(), places.size());
      std::vector<bool> used(g.size());
      for (unsigned int i = 0; i < g.size(); ++i)
        used[i] = places[i] == Place::inside;
      double                 smallest   = std::numeric_limits<double>::max();
      constexpr unsigned int max_pieces = 50;
      for (unsigned int piece = 0; piece < max_pieces; ++piece)
        {
          const auto        r = reduced_gradient(g, A, used);
          std::vector<bool> next(g.size());
          for (unsigned int i = 0; i < g.size(); ++i)
            next[i] = counts(r[i], places[i]);
          const auto p = restricted(r, next);
          smallest     = std::min(smallest, std::sqrt(dot(p, p)));
          if (next == used)
            break;
          used = next;
        }
      return smallest;
    }
  } // namespace optimization
} // namespace snug
