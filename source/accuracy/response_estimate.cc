#include <snug/accuracy/estimate.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::accuracy {
double ResponseEstimate::error() const
{
  return std::max({std::abs(cells + contact), std::abs(cells) / 2., std::abs(contact) / 2.}) +
         std::abs(reading) + data;
}

ResponseEstimate ResponseEstimate::of_cells(const std::vector<double> &cells,
                                            const std::vector<double> &contact,
                                            const double               factor,
                                            MPI_Comm                   comm)
{
  ResponseEstimate result;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    {
      result.cells += cells[cell];
      result.contact += factor * contact[cell];
      result.indicators.push_back(std::abs(cells[cell]) + std::abs(factor * contact[cell]));
    }
  result.cells   = dealii::Utilities::MPI::sum(result.cells, comm);
  result.contact = dealii::Utilities::MPI::sum(result.contact, comm);
  return result;
}

void ResponseEstimate::add_data(const std::vector<double> &of_cells,
                                const double               factor,
                                MPI_Comm                   comm)
{
  double sum = 0.;
  for (unsigned int cell = 0; cell < of_cells.size(); ++cell)
    {
      sum += of_cells[cell];
      indicators[cell] += std::abs(factor * of_cells[cell]);
    }
  data += std::abs(factor * dealii::Utilities::MPI::sum(sum, comm));
}
} // namespace snug::accuracy
