"""DDS domains for tests that may run beside others, of this user or of another one."""
import random
import socket

claims = {}


def is_quiet(domain):
    """Returns true if no process listens at the ports at which participants of the domain look for others."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as test:
        try:
            test.bind(("", 7400 + 250 * domain))
        except OSError:
            return False
    return True


def free_domain(domains):
    """Returns an unused domain that no other test takes until it is released or this process ends."""
    for domain in random.sample(list(domains), len(domains)):
        claim = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:
            # A name without a file: it goes with the process.
            claim.bind(f"\0swarmanoid_test_domain_{domain}")
        except OSError:
            claim.close()
            continue
        if is_quiet(domain):
            claims[domain] = claim
            return domain
        claim.close()
    raise AssertionError("all DDS domains are in use")


def release(domain):
    claims.pop(domain).close()
