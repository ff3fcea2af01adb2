#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/petsc_handle.h>
#include <snug/io/qp_export.h>
#include <snug/io/text_file.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

namespace snug::io {
namespace {
using petsc::check;

/// This rank's part of a matrix. Entries at the same place add up, zeros are kept.
struct Triplets
{
  PetscInt              n_rows = 0, n_columns = 0; ///< numbers of this rank
  std::vector<PetscInt> rows, columns;             ///< in the numbering of all ranks
  std::vector<double>   values;

  void add(const PetscInt row, const PetscInt column, const double value)
  {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
  }
};

/// Return the sum of @p n over the ranks before this one.
PetscInt offset(const PetscInt n, const MPI_Comm comm)
{
  PetscInt end = 0;
  MPI_Scan(&n, &end, 1, MPIU_INT, MPI_SUM, comm);
  return end - n;
}

class QpWriter
{
public:
  QpWriter(const std::string &directory, const MPI_Comm comm) : directory(directory), comm(comm) {}

  void write(const std::string &name, Triplets triplets) const
  {
    petsc::Matrix matrix;
    check(MatCreate(comm, matrix.put()));
    check(
      MatSetSizes(matrix, triplets.n_rows, triplets.n_columns, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(matrix, MATAIJ));
    check(MatSetPreallocationCOO(matrix, PetscCount(triplets.values.size()), triplets.rows.data(),
                                 triplets.columns.data()));
    check(MatSetValuesCOO(matrix, triplets.values.data(), INSERT_VALUES));
    const auto viewer = binary_file(name);
    check(MatView(matrix, viewer));
    write_text(name, matrix);
  }

  void write(const std::string &name, const std::vector<double> &values) const
  {
    petsc::Vector vector;
    check(VecCreateMPIWithArray(comm, 1, narrow<PetscInt>(values.size()), PETSC_DETERMINE,
                                values.data(), vector.put()));
    const auto viewer = binary_file(name);
    check(VecView(vector, viewer));
    PetscInt n;
    check(VecGetSize(vector, &n));
    std::ostringstream lines = numbers();
    for (const double value : values)
      lines << value << '\n';
    append(name, "array real general\n" + std::to_string(n) + " 1\n", lines.str());
  }

private:
  petsc::Viewer binary_file(const std::string &name) const
  {
    petsc::Viewer viewer;
    check(PetscViewerCreate(comm, viewer.put()));
    check(PetscViewerSetType(viewer, PETSCVIEWERBINARY));
    check(PetscViewerBinarySetSkipInfo(viewer, PETSC_TRUE)); // do not write NAME.petsc.info
    check(PetscViewerFileSetMode(viewer, FILE_MODE_WRITE));
    check(PetscViewerFileSetName(viewer, (directory + "/" + name + ".petsc").c_str()));
    return viewer;
  }

  static std::ostringstream numbers()
  {
    std::ostringstream lines;
    lines.precision(std::numeric_limits<double>::max_digits10);
    return lines;
  }

  /// Write the matrix in our own code, because PETSc's viewer of this format writes only six
  /// digits and no vectors.
  void write_text(const std::string &name, Mat matrix) const
  {
    std::ostringstream lines = numbers();
    PetscInt           first, last, n_rows, n_columns;
    long               n_entries = 0;
    check(MatGetOwnershipRange(matrix, &first, &last));
    check(MatGetSize(matrix, &n_rows, &n_columns));
    for (PetscInt row = first; row < last; ++row)
      {
        PetscInt           n;
        const PetscInt    *columns;
        const PetscScalar *values;
        check(MatGetRow(matrix, row, &n, &columns, &values));
        for (PetscInt p = 0; p < n; ++p)
          lines << row + 1 << ' ' << columns[p] + 1 << ' ' << values[p] << '\n';
        n_entries += n;
        check(MatRestoreRow(matrix, row, &n, &columns, &values));
      }
    MPI_Allreduce(MPI_IN_PLACE, &n_entries, 1, MPI_LONG, MPI_SUM, comm);
    append(name,
           "coordinate real general\n" + std::to_string(n_rows) + " " + std::to_string(n_columns) +
             " " + std::to_string(n_entries) + "\n",
           lines.str());
  }

  /// Append the lines of all ranks, one after the other.
  void append(const std::string &name, const std::string &header, const std::string &lines) const
  {
    const std::string path = directory + "/" + name + ".mtx";
    int               rank, n_ranks;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &n_ranks);
    for (int turn = 0; turn < n_ranks; ++turn)
      // Use throw_collectively(), because a full disk is an error of all ranks.
      throw_collectively(comm, [&]() {
        if (turn != rank)
          return;
        std::ofstream file(path, turn == 0 ? std::ios::trunc : std::ios::app);
        if (turn == 0)
          file << "%%MatrixMarket matrix " << header;
        file << lines << std::flush;
        if (!file)
          throw InputError("cannot write '" + path + "'");
      });
  }

  std::string directory;
  MPI_Comm    comm;
};

std::vector<double> column(const qp::MultiVector &x)
{
  return {x.column(0), x.column(0) + x.n_rows()};
}

std::vector<double> joined(const feti::PrimalVectors &parts)
{
  std::vector<double> all;
  for (const auto &part : parts)
    all.insert(all.end(), part.column(0), part.column(0) + part.n_rows());
  return all;
}

/// The matrices K, B and R. Their unknowns are those of all subdomains, one after the other.
struct Matrices
{
  Matrices(const feti::LoadedProblem &feti, const feti::RowLayout &layout);

  Triplets K, B, R;
};

Matrices::Matrices(const feti::LoadedProblem &feti, const feti::RowLayout &layout)
{
  const auto &linearization = feti.linearization();
  for (const auto &system : linearization.subdomains())
    {
      K.n_rows += system.n_dofs();
      R.n_columns += system.R.n_columns();
    }
  K.n_columns = B.n_columns = R.n_rows = K.n_rows;
  B.n_rows                             = layout.n_owned();
  PetscInt dof                         = offset(K.n_rows, layout.communicator());
  PetscInt mode                        = offset(R.n_columns, layout.communicator());
  for (unsigned int s = 0; s < linearization.B().size(); ++s)
    {
      const auto &system = linearization.subdomains()[s];
      for (unsigned int i = 0; i < system.n_dofs(); ++i)
        for (PetscInt p = system.K.row_start()[i]; p < system.K.row_start()[i + 1]; ++p)
          K.add(dof + i, dof + system.K.columns()[p], system.K.values[p]);
      for (const auto &entry : linearization.B()[s])
        B.add(layout.global_row_of_local(entry.row), dof + entry.dof, entry.value);
      for (unsigned int i = 0; i < system.n_dofs(); ++i)
        for (unsigned int j = 0; j < system.R.n_columns(); ++j)
          R.add(dof + i, mode + j, system.R(i, j));
      dof += system.n_dofs();
      mode += system.R.n_columns();
    }
}
} // namespace

void export_qp(const std::string         &directory,
               const feti::LoadedProblem &feti,
               const feti::RowLayout     &layout,
               const feti::PrimalVectors &u,
               const qp::MultiVector     &lambda)
{
  make_output_directory(feti.context(), directory);
  const QpWriter writer(directory, layout.communicator());
  Matrices       matrices(feti, layout);
  writer.write("K", std::move(matrices.K));
  writer.write("B", std::move(matrices.B));
  writer.write("R", std::move(matrices.R));
  writer.write("f", joined(feti.loads()));
  writer.write("g", column(feti.g()));
  writer.write("bounded",
               std::vector<double>(layout.contact_rows().begin(), layout.contact_rows().end()));
  writer.write("u", joined(u));
  writer.write("lambda", column(lambda));
}
} // namespace snug::io
