#include "core/file/descriptor_buffer.hpp"

#include <unistd.h>

#include <cerrno>

namespace nextview {

DescriptorBuffer::DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
  setp(held_.data(), held_.data() + held_.size());
}

int DescriptorBuffer::flush() {
  const char* next = pbase();
  while (error_ == 0 && next < pptr()) {
    const ssize_t written = ::write(descriptor_, next, static_cast<std::size_t>(pptr() - next));
    if (written >= 0)
      next += written;
    else if (errno != EINTR)
      error_ = errno;
  }
  setp(held_.data(), held_.data() + held_.size());
  return error_;
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type byte) {
  if (flush() != 0) return traits_type::eof();
  if (!traits_type::eq_int_type(byte, traits_type::eof())) sputc(traits_type::to_char_type(byte));
  return traits_type::not_eof(byte);
}

}  // namespace nextview
